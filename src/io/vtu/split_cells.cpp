// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/split_cells.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace tessera::io {
namespace {

using Side = std::array<std::size_t, 4>;
constexpr std::size_t kNone = 8;  // In place of the fourth corner of a triangle.

// Corners come first in all kinds of cells; their order is that of VTK.
constexpr std::array<Side, 4> kTetSides{
    {{0, 1, 3, kNone}, {1, 2, 3, kNone}, {2, 0, 3, kNone}, {0, 2, 1, kNone}}};
constexpr std::array<Side, 5> kPyramidSides{
    {{0, 3, 2, 1}, {0, 1, 4, kNone}, {1, 2, 4, kNone}, {2, 3, 4, kNone}, {3, 0, 4, kNone}}};
constexpr std::array<Side, 5> kWedgeSides{
    {{0, 1, 2, kNone}, {3, 5, 4, kNone}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
constexpr std::array<Side, 6> kHexSides{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
constexpr std::array<Side, 6> kVoxelSides{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

struct Shape {
  std::size_t num_corners = 0;
  std::span<const Side> sides{};
};

// By VTK's number of the type: linear, of second order, Lagrange's and Bézier's.
std::optional<Shape> shape_of(std::uint8_t type)
{
  switch (type) {
    case 10:
    case 24:
    case 71:
    case 78:
      return Shape{4, kTetSides};
    case 11:
      return Shape{8, kVoxelSides};
    case 12:
    case 25:
    case 29:
    case 33:
    case 72:
    case 79:
      return Shape{8, kHexSides};
    case 13:
    case 26:
    case 31:
    case 32:
    case 73:
    case 80:
      return Shape{6, kWedgeSides};
    case 14:
    case 27:
    case 37:
    case 74:
    case 81:
      return Shape{5, kPyramidSides};
    default:
      return std::nullopt;
  }
}

// Prisms of five and six sides, convex point sets, polyhedra.
bool has_volume_but_no_shape(std::uint8_t type)
{
  return type == 15 || type == 16 || type == 41 || type == 42;
}

using Points = std::vector<LocalIndex>;

// A fan of triangles around the lowest point of a side: both cells beside it cut it so.
void add_cone(LocalIndex apex, const Side& side, const Points& corners, Points& tets)
{
  const std::size_t num_corners = side[3] == kNone ? 3 : 4;
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < num_corners; ++i) {
    if (corners[side[i]] < corners[side[lowest]]) lowest = i;
  }
  const auto point = [&](std::size_t i) { return corners[side[(lowest + i) % num_corners]]; };
  for (std::size_t i = 1; i + 1 < num_corners; ++i) {
    tets.insert(tets.end(), {apex, point(0), point(i), point(i + 1)});
  }
}

// Cones from the cell's lowest point to the sides that do not have it. Those that have it are so
// cut by the diagonal from it, which is their lowest point too.
void add_tets(const Shape& shape, const Points& corners, Points& tets)
{
  const auto lowest = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
  for (const Side& side : shape.sides) {
    if (std::ranges::find(side, lowest) == side.end()) {
      add_cone(corners[lowest], side, corners, tets);
    }
  }
}

}  // namespace

std::vector<LocalIndex> split_into_tets(const MixedCells& cells, std::size_t num_points)
{
  Points tets;
  Points corners;
  for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
    const std::uint8_t type = cells.types[cell];
    if (has_volume_but_no_shape(type)) {
      throw InputError(fmt::format("it has cells of VTK's type {}, which cannot be read", type));
    }
    const std::optional<Shape> shape = shape_of(type);
    if (!shape) continue;
    const auto points = cells.points_of(cell);
    require(points.size() >= shape->num_corners, "a cell has not the number of points of its type");
    corners.clear();
    for (const LocalIndex point : points.first(shape->num_corners)) {
      require(point >= 0 && std::cmp_less(point, num_points),
              "a cell has a point that does not exist");
      corners.push_back(point);
    }
    add_tets(*shape, corners, tets);
  }
  return tets;
}

}  // namespace tessera::io
