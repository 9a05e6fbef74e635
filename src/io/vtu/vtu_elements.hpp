// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/types.hpp"

#include "io/vtu/data_array.hpp"
#include "io/vtu/xml.hpp"

namespace tessera::io {

inline constexpr std::string_view kTooManyPoints = "it has more than 2^31 points; split it";

/// @brief @throws InputError unless the condition holds.
inline void require(bool condition,
                    std::string_view what)  // No std::string: this stands in inner loops.
{
  if (!condition) throw InputError(std::string(what));
}

[[nodiscard]] inline std::string name_of(const XmlElement& element)
{
  return element.attribute_or("Name", "");
}

/// @brief The array's values as T. @throws InputError if there are not `num_values`, or they do not
/// fit.
template <class T>
[[nodiscard]] std::vector<T> read_values(const XmlElement& element, const Encoding& encoding)
{
  auto values = values_as<T>(decode_array(element, encoding));
  require(values.has_value(), fmt::format("array {} has values out of range", name_of(element)));
  return *std::move(values);
}

/// @brief The child of that name. @throws InputError if there is none.
[[nodiscard]] const XmlElement& required_child(const XmlElement& element, std::string_view name);

/// @brief The array of that name among the children. @throws InputError if there is none.
[[nodiscard]] const XmlElement& named_array(const XmlElement& parent, std::string_view name);

/// @brief @throws InputError unless the file ends as a complete VTK XML file does.
void require_complete(std::string_view file);

/// @brief Cells as stored: any mix of kinds.
struct MixedCells {
  std::vector<LocalIndex> connectivity{};
  std::vector<GlobalIndex> offsets{};  ///< End of each cell in `connectivity`.
  std::vector<std::uint8_t> types{};

  [[nodiscard]] std::span<const LocalIndex> points_of(std::size_t cell) const
  {
    const auto begin = cell == 0 ? 0 : static_cast<std::size_t>(offsets[cell - 1]);
    return std::span(connectivity).subspan(begin, static_cast<std::size_t>(offsets[cell]) - begin);
  }
};

/// @brief Cells of an element "Piece". @throws InputError if they are corrupt; points are not
/// looked at.
[[nodiscard]] MixedCells read_cells(const XmlElement& piece, const Encoding& encoding);

/// @brief Points of an element "Piece", shape (num_points, 3). @throws InputError
[[nodiscard]] std::vector<double> read_points(const XmlElement& piece, const Encoding& encoding);

}  // namespace tessera::io
