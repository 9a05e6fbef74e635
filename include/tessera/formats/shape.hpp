// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <tuple>

namespace tessera::formats {

/// @brief What elements of a mesh look like: cells, then faces on its patches, then edges on lines
/// inside of solids.
enum class Shape : int { tet, pyramid, prism, triangle, quad, line };
[[nodiscard]] constexpr Shape last_value(Shape /*type*/) { return Shape::line; }

inline constexpr std::array kCellShapes{Shape::tet, Shape::pyramid, Shape::prism};
inline constexpr std::array kFaceShapes{Shape::triangle, Shape::quad};
/// What every format has: cells and faces.
inline constexpr std::array kShapes{Shape::tet, Shape::pyramid, Shape::prism, Shape::triangle,
                                    Shape::quad};
inline constexpr std::array kAllShapes{Shape::tet,      Shape::pyramid, Shape::prism,
                                       Shape::triangle, Shape::quad,    Shape::line};

/// @brief Whether elements of this shape are cells, which have a material. Faces have a patch, and
/// edges a line.
[[nodiscard]] constexpr bool is_cell(Shape shape) { return shape <= Shape::prism; }

/// @brief A value for each shape, in their order.
template <class T>
struct ByShape {
  std::array<T, kAllShapes.size()> values{};

  [[nodiscard]] constexpr T& operator[](Shape shape)
  {
    return values[static_cast<std::size_t>(shape)];
  }
  [[nodiscard]] constexpr const T& operator[](Shape shape) const
  {
    return values[static_cast<std::size_t>(shape)];
  }

  static auto fields(auto& self) { return std::tie(self.values); }
};

[[nodiscard]] constexpr std::size_t num_corners(Shape shape)
{
  return ByShape<std::size_t>{{4, 5, 6, 3, 4, 2}}[shape];
}

}  // namespace tessera::formats
