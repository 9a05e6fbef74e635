// SPDX-License-Identifier: BSD-3-Clause
#include "formats/cells.hpp"

#include <algorithm>
#include <array>

#include "formats/joined_tets.hpp"

namespace tessera::formats {
namespace {

void append(std::vector<LocalIndex>& points, std::span<const LocalIndex> more)
{
  points.insert(points.end(), more.begin(), more.end());
}

// Of the corners of a face of a prism, as places in it.
std::size_t side_of_prism(std::span<const std::size_t> places)
{
  std::array<bool, 3> has_column{};
  for (const std::size_t place : places) has_column[place % 3] = true;
  if (std::ranges::count(has_column, true) == 3) return places[0] < 3 ? 3 : 4;
  const auto missing =
      static_cast<std::size_t>(std::ranges::find(has_column, false) - has_column.begin());
  return (missing + 1) % 3;
}

std::size_t side_of_pyramid(std::span<const std::size_t> places)
{
  constexpr std::size_t kTop = 4;
  std::vector<std::size_t> on_base(places.begin(), places.end());
  if (std::erase(on_base, kTop) == 0) return 4;
  const auto [low, high] = std::minmax(on_base[0], on_base[1]);
  return low == 0 && high == 3 ? 3 : low;
}

}  // namespace

std::vector<GlobalIndex> point_numbers(const Piece& piece, const ElementList& list,
                                       GlobalIndex first)
{
  std::vector<GlobalIndex> numbers;
  numbers.reserve(list.points.size());
  for (const LocalIndex row : list.points) numbers.push_back(piece.point_numbers[at(row)] + first);
  return numbers;
}

PieceCells::PieceCells(const Piece& piece)
    : piece_(piece), has_prisms_(piece.num_cells() != piece.num_tets())
{
  if (!has_prisms_) return;
  join_cells();
  join_faces();
}

ElementList PieceCells::operator[](Shape shape) const
{
  const auto list = [&](std::span<const LocalIndex> points, std::span<const std::int32_t> tags) {
    const std::size_t width = tags.empty() ? num_corners(shape) : points.size() / tags.size();
    return ElementList{width, points, tags};
  };
  if (shape == Shape::line) return list(piece_.line_points, piece_.line);
  if (has_prisms_) return list(points_[shape], tags_[shape]);
  if (shape == Shape::tet) return list(piece_.tet_points, piece_.tet_material);
  if (shape == Shape::triangle) return list(piece_.triangle_points, piece_.triangle_patch);
  return list({}, {});
}

CellPlace PieceCells::cell_of(LocalIndex tet) const
{
  return has_prisms_ ? cell_of_tet_[at(tet)] : CellPlace{Shape::tet, tet};
}

std::vector<std::int32_t> PieceCells::patches() const
{
  std::vector<std::int32_t> patches;
  for (const Shape shape : kFaceShapes) {
    const auto more = (*this)[shape].tags;
    patches.insert(patches.end(), more.begin(), more.end());
  }
  return patches;
}

LocalIndex PieceCells::tet_side(std::size_t face) const
{
  return has_prisms_ ? sides_[face] : piece_.triangle_side[face];
}

CellSide PieceCells::side_of(std::size_t face) const
{
  const LocalIndex side = tet_side(face);
  const CellPlace cell = cell_of(side / 4);
  if (cell.shape == Shape::tet) return {cell, at(side % 4)};
  const std::size_t num_triangles = tags_[Shape::triangle].size();
  const auto points = face < num_triangles ? (*this)[Shape::triangle].of(face)
                                           : (*this)[Shape::quad].of(face - num_triangles);
  const auto corners = (*this)[cell.shape].of(at(cell.row));
  std::vector<std::size_t> places;
  for (const LocalIndex point : points) {
    const auto place = std::ranges::find(corners, point) - corners.begin();
    places.push_back(static_cast<std::size_t>(place));
  }
  return {cell, cell.shape == Shape::prism ? side_of_prism(places) : side_of_pyramid(places)};
}

void PieceCells::join_cells()
{
  const JoinedTets tets(piece_);
  for (LocalIndex tet = 0; tet < tets.num_tets();) {
    const CellTets cell = tets_of_cell(tets, tet);
    const Shape shape = cell.shape();
    if (shape == Shape::prism) append(points_[shape], prism_corners(tets, tet));
    if (shape == Shape::pyramid) append(points_[shape], pyramid_corners(tets, tet));
    if (shape == Shape::tet) append(points_[shape], tets.corners(tet));
    const auto row = static_cast<LocalIndex>(tags_[shape].size());
    cell_of_tet_.insert(cell_of_tet_.end(), at(cell.count), {shape, row});
    tags_[shape].push_back(piece_.tet_material[at(tet)]);
    tet += cell.count;
  }
}

void PieceCells::join_faces()
{
  const JoinedTets tets(piece_);
  const std::vector<LocalIndex>& sides = piece_.triangle_side;
  const std::vector<JoinedSide> joined = joined_sides(tets, sides);
  for (const Shape shape : kFaceShapes) {
    for (const JoinedSide& side : joined) {
      if (side.shape() != shape) continue;
      append(points_[shape], corners_of(tets, sides, side));
      tags_[shape].push_back(piece_.triangle_patch[at(side.row)]);
      sides_.push_back(sides[at(side.row)]);
    }
  }
}

}  // namespace tessera::formats
