// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

#include "formats/tets_behind.hpp"

namespace tessera::formats {
namespace {

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

}  // namespace

std::vector<FoamFace> foam_inner_faces(const Piece& piece, GlobalIndex first_tet)
{
  const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
  std::vector<FoamFace> faces;
  faces.reserve(behind.size() / 2);
  auto seam = piece.seams.begin();
  for (LocalIndex tet = 0; tet < piece.num_tets(); ++tet) {
    const auto first_of_tet = static_cast<std::ptrdiff_t>(faces.size());
    for (LocalIndex side = 4 * tet; side < 4 * tet + 4; ++side) {
      if (behind[at(side)] > tet) faces.push_back({side, first_tet + behind[at(side)]});
      if (seam == piece.seams.end() || seam->side != side) continue;
      if (seam->other_piece > piece.number) faces.push_back({side, seam->other_tet});
      ++seam;
    }
    std::ranges::sort(faces.begin() + first_of_tet, faces.end(), {}, &FoamFace::neighbour);
  }
  return faces;
}

std::vector<LocalIndex> foam_seam_faces(const Piece& piece, GlobalIndex first_tet,
                                        LocalIndex other_piece)
{
  using Key = std::pair<GlobalIndex, GlobalIndex>;  // The tet of the lower piece first.
  std::vector<std::pair<Key, LocalIndex>> faces;
  for (const SeamFace& seam : piece.seams) {
    if (seam.other_piece != other_piece) continue;
    const GlobalIndex own_tet = first_tet + seam.side / 4;
    faces.push_back({std::minmax({own_tet, seam.other_tet}), seam.side});
  }
  std::ranges::sort(faces);
  std::vector<LocalIndex> sides;
  for (const auto& [key, side] : faces) sides.push_back(side);
  return sides;
}

std::vector<LocalIndex> foam_patch_faces(const Piece& piece, std::int32_t tag)
{
  if (tag == kNoPatchTag) return faces_without_patch(piece);
  std::vector<LocalIndex> sides;
  for (std::size_t t = 0; t < piece.triangle_side.size(); ++t) {
    if (piece.triangle_patch[t] == tag && piece.is_inner_triangle[t] == 0)
      sides.push_back(piece.triangle_side[t]);
  }
  return sides;
}

std::array<LocalIndex, 3> foam_face_points(const Piece& piece, LocalIndex side)
{
  const auto& corners = mesh::kTetFaceCorners[at(side % 4)];
  std::array<LocalIndex, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) rows[i] = piece.tet_points[4 * at(side / 4) + corners[i]];
  const auto lowest = std::ranges::min_element(
      rows, {}, [&](LocalIndex row) { return piece.point_numbers[at(row)]; });
  std::ranges::rotate(rows, lowest);
  return rows;
}

std::vector<std::vector<std::int32_t>> foam_zone_tets(const Piece& piece, std::size_t num_materials,
                                                      GlobalIndex first_tet)
{
  std::vector<std::vector<std::int32_t>> tets(num_materials);
  for (std::size_t t = 0; t < piece.tet_material.size(); ++t) {
    tets[at(piece.tet_material[t] - 1)].push_back(
        static_cast<std::int32_t>(first_tet + static_cast<GlobalIndex>(t)));
  }
  return tets;
}

}  // namespace tessera::formats
