// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/faces.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "formats/joined_tets.hpp"
#include "formats/link/tets_behind.hpp"
#include "formats/periodic_nodes.hpp"

namespace tessera::formats {
namespace {

FoamFace face_of_side(const Piece& piece, LocalIndex side, GlobalIndex neighbour = 0)
{
  FoamFace face{.owner = piece.tet_cell[at(side / 4)], .neighbour = neighbour, .side = side};
  std::ranges::copy(triangle_of_side(JoinedTets(piece), side), face.points.begin());
  return face;
}

void join_half(const Piece& piece, LocalIndex other_side, FoamFace& face)
{
  const JoinedTets tets(piece);
  face.points = quad_of(triangle_of_side(tets, face.side), triangle_of_side(tets, other_side));
  face.num_points = 4;
}

void begin_at(LocalIndex point, FoamFace& face)
{
  const auto points = std::span(face.points).first(static_cast<std::size_t>(face.num_points));
  std::rotate(points.begin(), std::ranges::find(points, point), points.end());
}

void begin_at_lowest(const Piece& piece, FoamFace& face)
{
  const auto points = std::span(face.points).first(static_cast<std::size_t>(face.num_points));
  begin_at(*std::ranges::min_element(points, {},
                                     [&](LocalIndex row) { return piece.point_numbers[at(row)]; }),
           face);
}

// Joins triangles that stand side by side in the list and lie between the same two cells.
void join_equal(const Piece& piece, std::vector<FoamFace>& faces, std::size_t first)
{
  std::size_t num_kept = first;
  for (std::size_t i = first; i < faces.size(); ++i) {
    FoamFace face = faces[i];
    const bool is_pair = i + 1 < faces.size() && faces[i + 1].owner == face.owner
                         && faces[i + 1].neighbour == face.neighbour;
    if (is_pair) join_half(piece, faces[++i].side, face);
    begin_at_lowest(piece, face);
    faces[num_kept++] = face;
  }
  faces.resize(num_kept);
}

std::vector<LocalIndex> faces_without_patch(const Piece& piece)
{
  const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
  std::vector<bool> is_known(behind.size());
  for (std::size_t side = 0; side < behind.size(); ++side)
    is_known[side] = behind[side] != kNoIndex;
  for (const SeamFace& seam : piece.seams) is_known[at(seam.side)] = true;
  for (const LocalIndex side : piece.triangle_side) is_known[at(side)] = true;
  std::vector<LocalIndex> sides;
  for (std::size_t side = 0; side < behind.size(); ++side)
    if (!is_known[side]) sides.push_back(static_cast<LocalIndex>(side));
  return sides;
}

std::vector<LocalIndex> sides_of_patch(const Piece& piece, std::int32_t tag)
{
  if (tag == kNoPatchTag) return faces_without_patch(piece);
  std::vector<LocalIndex> sides;
  for (std::size_t t = 0; t < piece.triangle_side.size(); ++t) {
    if (piece.triangle_patch[t] == tag && piece.is_inner_triangle[t] == 0)
      sides.push_back(piece.triangle_side[t]);
  }
  return sides;
}

FaceCount count_of(std::int32_t tag, std::span<const FoamFace> faces)
{
  FaceCount count{.tag = tag, .num_faces = static_cast<GlobalIndex>(faces.size())};
  for (const FoamFace& face : faces) count.num_corners += face.num_points;
  return count;
}

}  // namespace

std::vector<FoamFace> foam_inner_faces(const Piece& piece, GlobalIndex first_cell)
{
  const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
  std::vector<FoamFace> faces;
  faces.reserve(behind.size() / 2);
  auto seam = piece.seams.begin();
  for (LocalIndex tet = 0; tet < piece.num_tets();) {
    const LocalIndex cell = piece.tet_cell[at(tet)];
    const std::size_t first_of_cell = faces.size();
    for (; tet < piece.num_tets() && piece.tet_cell[at(tet)] == cell; ++tet) {
      for (LocalIndex side = 4 * tet; side < 4 * tet + 4; ++side) {
        const LocalIndex other =
            behind[at(side)] == kNoIndex ? kNoIndex : piece.tet_cell[at(behind[at(side)])];
        if (other > cell) faces.push_back(face_of_side(piece, side, first_cell + other));
        if (seam == piece.seams.end() || seam->side != side) continue;
        if (seam->other_piece > piece.number)
          faces.push_back(face_of_side(piece, side, seam->other_cell));
        ++seam;
      }
    }
    std::ranges::sort(faces.begin() + static_cast<std::ptrdiff_t>(first_of_cell), faces.end(), {},
                      [](const FoamFace& face) { return std::pair(face.neighbour, face.side); });
    join_equal(piece, faces, first_of_cell);
  }
  return faces;
}

std::vector<FoamFace> foam_seam_faces(const Piece& piece, GlobalIndex first_cell,
                                      LocalIndex other_piece)
{
  std::vector<FoamFace> faces;
  for (const SeamFace& seam : piece.seams) {
    if (seam.other_piece == other_piece)
      faces.push_back(face_of_side(piece, seam.side, seam.other_cell));
  }
  // The cell of the lower piece first.
  std::ranges::sort(faces, {}, [&](const FoamFace& face) {
    const GlobalIndex owner = first_cell + face.owner;
    return std::tuple(std::min(owner, face.neighbour), std::max(owner, face.neighbour), face.side);
  });
  join_equal(piece, faces, 0);
  return faces;
}

std::vector<FoamFace> foam_patch_faces(const Piece& piece, std::int32_t tag)
{
  const std::vector<LocalIndex> sides = sides_of_patch(piece, tag);
  std::vector<FoamFace> faces;
  for (const JoinedSide& side : joined_sides(JoinedTets(piece), sides)) {
    FoamFace face = face_of_side(piece, sides[at(side.row)]);
    if (side.other_row != kNoIndex) join_half(piece, sides[at(side.other_row)], face);
    begin_at_lowest(piece, face);
    faces.push_back(face);
  }
  return faces;
}

std::span<const CyclicFace> cyclic_faces_of(const Piece& piece, std::int32_t tag)
{
  return rows_of_patch(piece.cyclic_faces, tag);
}

std::vector<FoamFace> foam_cyclic_faces(const Piece& piece, std::span<const CyclicFace> cyclic)
{
  if (cyclic.empty()) return {};
  const std::vector<FoamFace> of_patch = foam_patch_faces(piece, cyclic.front().patch);
  std::vector<FoamFace> faces;
  for (const CyclicFace& one : cyclic) {
    faces.push_back(of_patch[at(one.row)]);
    begin_at(one.first_point, faces.back());
  }
  return faces;
}

std::vector<std::vector<std::int32_t>> foam_zone_cells(const Piece& piece,
                                                       std::size_t num_materials,
                                                       GlobalIndex first_cell)
{
  std::vector<std::vector<std::int32_t>> cells(num_materials);
  for (std::size_t t = 0; t < piece.tet_material.size(); ++t) {
    if (t > 0 && piece.tet_cell[t] == piece.tet_cell[t - 1]) continue;
    cells[at(piece.tet_material[t] - 1)].push_back(
        static_cast<std::int32_t>(first_cell + piece.tet_cell[t]));
  }
  return cells;
}

CellFaceCounts count_cell_faces(const Piece& piece, GlobalIndex first_cell, std::size_t num_patches,
                                std::size_t num_materials)
{
  CellFaceCounts counts;
  counts.inner = count_of(0, foam_inner_faces(piece, first_cell));
  for (std::int32_t tag = 0; tag <= static_cast<std::int32_t>(num_patches); ++tag) {
    const FaceCount of_patch = count_of(tag, foam_patch_faces(piece, tag));
    if (of_patch.num_faces > 0) counts.of_patch.push_back(of_patch);
  }
  const auto zones = foam_zone_cells(piece, num_materials, 0);
  for (std::size_t m = 0; m < zones.size(); ++m) {
    if (zones[m].empty()) continue;
    counts.of_material.push_back(
        {static_cast<std::int32_t>(m) + 1, static_cast<GlobalIndex>(zones[m].size())});
  }
  return counts;
}

}  // namespace tessera::formats
