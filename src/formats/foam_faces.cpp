// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

#include "formats/tets_behind.hpp"

namespace tessera::formats {
namespace {

FoamFace face_of_side(const Piece& piece, LocalIndex side, GlobalIndex neighbour = 0)
{
  FoamFace face{.owner = piece.tet_cell[at(side / 4)], .neighbour = neighbour, .side = side};
  const auto& corners = mesh::kTetFaceCorners[at(side % 4)];
  for (std::size_t i = 0; i < 3; ++i)
    face.points[i] = piece.tet_points[4 * at(side / 4) + corners[i]];
  return face;
}

void begin_at_lowest(const Piece& piece, FoamFace& face)
{
  const auto points = std::span(face.points).first(static_cast<std::size_t>(face.num_points));
  const auto lowest = std::ranges::min_element(
      points, {}, [&](LocalIndex row) { return piece.point_numbers[at(row)]; });
  std::ranges::rotate(points, lowest);
}

bool has(const FoamFace& face, LocalIndex point)
{
  return std::ranges::find(face.corners(), point) != face.corners().end();
}

// Two triangles with a common edge become four corners: the other one's third corner goes between
// the ends of that edge.
FoamFace joined(const FoamFace& a, const FoamFace& b)
{
  const auto others = b.corners();
  const LocalIndex apex =
      *std::ranges::find_if(others, [&](LocalIndex point) { return !has(a, point); });
  FoamFace face = a;
  face.num_points = 4;
  std::size_t to = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const LocalIndex next = a.points[(i + 1) % 3];
    face.points[to++] = a.points[i];
    if (has(b, a.points[i]) && has(b, next)) face.points[to++] = apex;
  }
  return face;
}

// Joins triangles that stand side by side in the list and lie between the same two cells.
void join_equal(const Piece& piece, std::vector<FoamFace>& faces, std::size_t first)
{
  std::size_t num_kept = first;
  for (std::size_t i = first; i < faces.size(); ++i) {
    FoamFace face = faces[i];
    const bool is_pair = i + 1 < faces.size() && faces[i + 1].owner == face.owner
                         && faces[i + 1].neighbour == face.neighbour;
    if (is_pair) face = joined(face, faces[++i]);
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

// First tet of a prism of three, if the tet is of one.
std::optional<LocalIndex> prism_of(const Piece& piece, LocalIndex tet)
{
  const LocalIndex cell = piece.tet_cell[at(tet)];
  const auto [first, last] = std::ranges::equal_range(piece.tet_cell, cell);
  if (last - first != 3) return std::nullopt;
  return static_cast<LocalIndex>(first - piece.tet_cell.begin());
}

// Sides of the tets of a prism that lie in one side of the prism, pair by pair.
//
// The tets go up a stair: each has one corner that the one before it lacks, and lacks one corner of
// that. So p2 and q1, p1 and q0 are found, where p and q are the ends of columns; p0 comes first.
std::array<std::array<LocalIndex, 2>, 3> halves_of_sides(const Piece& piece, LocalIndex first)
{
  const auto corners = [&](LocalIndex tet) {
    return std::span(piece.tet_points).subspan(4 * at(tet), 4);
  };
  const auto only_in = [&](LocalIndex tet, LocalIndex other) {
    return *std::ranges::find_if(corners(tet), [&](LocalIndex v) {
      return std::ranges::find(corners(other), v) == corners(other).end();
    });
  };
  const auto side_opposite = [&](LocalIndex tet, LocalIndex v) {
    const auto all = corners(tet);
    return static_cast<LocalIndex>(4 * tet + (std::ranges::find(all, v) - all.begin()));
  };
  const LocalIndex low = first;
  const LocalIndex middle = first + 1;
  const LocalIndex high = first + 2;
  const LocalIndex p0 = corners(low)[0];
  const LocalIndex p1 = only_in(middle, high);
  const LocalIndex q1 = only_in(middle, low);
  const LocalIndex p2 = only_in(low, middle);
  const LocalIndex q2 = *std::ranges::find_if(
      corners(low), [&](LocalIndex v) { return v != p0 && v != p1 && v != p2; });
  return {{{side_opposite(low, p1), side_opposite(high, q1)},
           {side_opposite(middle, q2), side_opposite(high, q2)},
           {side_opposite(low, p0), side_opposite(middle, p0)}}};
}

// The other half of a prism's side; kNoIndex if the side is one of its ends, or of no prism of
// three tets.
LocalIndex other_half(const Piece& piece, LocalIndex side)
{
  const auto first = prism_of(piece, side / 4);
  if (!first) return kNoIndex;
  for (const auto& [a, b] : halves_of_sides(piece, *first)) {
    if (side == a) return b;
    if (side == b) return a;
  }
  return kNoIndex;
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
  std::vector<LocalIndex> sorted = sides;
  std::ranges::sort(sorted);
  std::vector<FoamFace> faces;
  for (const LocalIndex side : sides) {
    const LocalIndex half = other_half(piece, side);
    const bool is_pair = half != kNoIndex && std::ranges::binary_search(sorted, half);
    if (is_pair && half < side) continue;  // It went with the other half.
    FoamFace face = face_of_side(piece, side);
    if (is_pair) face = joined(face, face_of_side(piece, half));
    begin_at_lowest(piece, face);
    faces.push_back(face);
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
