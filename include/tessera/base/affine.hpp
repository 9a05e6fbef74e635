// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <tuple>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief A rotation and a shift: p goes to rows * p + shift.
struct Affine {
  std::array<Vec3, 3> rows{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  Vec3 shift{};  ///< Output length unit unless said otherwise.

  static auto fields(auto& self) { return std::tie(self.rows, self.shift); }
  friend bool operator==(const Affine&, const Affine&) = default;

  /// @brief Without the shift.
  [[nodiscard]] constexpr Vec3 turned(const Vec3& p) const noexcept
  {
    return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
  }
  [[nodiscard]] constexpr Vec3 operator()(const Vec3& p) const noexcept
  {
    return turned(p) + shift;
  }
  /// @brief What leads back.
  [[nodiscard]] constexpr Affine inverse() const noexcept
  {
    Affine back;
    for (std::size_t i = 0; i < 3; ++i) back.rows[i] = {rows[0][i], rows[1][i], rows[2][i]};
    back.shift = -1.0 * back.turned(shift);
    return back;
  }
};

/// @brief First `first`, then `then`.
[[nodiscard]] constexpr Affine product(const Affine& then, const Affine& first) noexcept
{
  Affine both;
  const Affine columns = first.inverse();
  for (std::size_t i = 0; i < 3; ++i) both.rows[i] = columns.turned(then.rows[i]);
  both.shift = then(first.shift);
  return both;
}

}  // namespace tessera
