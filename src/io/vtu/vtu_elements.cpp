// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/vtu_elements.hpp"

#include <algorithm>
#include <utility>

namespace tessera::io {

const XmlElement& required_child(const XmlElement& element, std::string_view name)
{
  const XmlElement* const child = element.child(name);
  require(child != nullptr, fmt::format("element {} has no {}", element.name, name));
  return *child;
}

const XmlElement& named_array(const XmlElement& parent, std::string_view name)
{
  for (const XmlElement& element : parent.children) {
    if (name_of(element) == name) return element;
  }
  throw InputError(fmt::format("element {} has no array {}", parent.name, name));
}

// A complete file ends with its root element, also when its data are raw bytes.
void require_complete(std::string_view file)
{
  const std::size_t last = file.find_last_not_of(" \t\r\n");
  require(last != std::string_view::npos && file.substr(0, last + 1).ends_with("</VTKFile>"),
          "it is cut off, or no VTK XML file");
}

MixedCells read_cells(const XmlElement& piece, const Encoding& encoding)
{
  MixedCells cells;
  const std::size_t num_cells = piece.count_attribute("NumberOfCells");
  if (num_cells == 0) return cells;
  const XmlElement& element = required_child(piece, "Cells");
  cells.connectivity = read_values<LocalIndex>(named_array(element, "connectivity"), encoding);
  cells.offsets = read_values<GlobalIndex>(named_array(element, "offsets"), encoding);
  cells.types = read_values<std::uint8_t>(named_array(element, "types"), encoding);
  require(cells.offsets.size() == num_cells && cells.types.size() == num_cells,
          "the cells are not as many as the file says");
  require(std::ranges::is_sorted(cells.offsets) && cells.offsets.front() >= 0
              && std::cmp_less_equal(cells.offsets.back(), cells.connectivity.size()),
          "the offsets of the cells are corrupt");
  return cells;
}

std::vector<double> read_points(const XmlElement& piece, const Encoding& encoding)
{
  const std::size_t num_points = piece.count_attribute("NumberOfPoints");
  if (num_points == 0) return {};
  const XmlElement& points = required_child(piece, "Points");
  require(!points.children.empty(), "element Points has no array");
  std::vector<double> xyz = read_values<double>(points.children.front(), encoding);
  require(xyz.size() / 3 == num_points && xyz.size() % 3 == 0,
          "the points are not as many as the file says");
  return xyz;
}

}  // namespace tessera::io
