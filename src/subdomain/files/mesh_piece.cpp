// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <unordered_map>
#include <utility>

#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::subdomain {
namespace {

// Rows among the tets' points of the boundary's points.
std::vector<LocalIndex> rows_of(const std::vector<GlobalIndex>& boundary_ids,
                                const std::vector<GlobalIndex>& point_ids)
{
  std::unordered_map<GlobalIndex, LocalIndex> boundary_row;
  boundary_row.reserve(boundary_ids.size());
  for (const GlobalIndex id : boundary_ids) {
    boundary_row.emplace(id, static_cast<LocalIndex>(boundary_row.size()));
  }
  std::vector<LocalIndex> rows(boundary_ids.size(), kNoIndex);
  for (std::size_t p = 0; p < point_ids.size(); ++p) {
    const auto found = boundary_row.find(point_ids[p]);
    if (found != boundary_row.end()) rows[at(found->second)] = static_cast<LocalIndex>(p);
  }
  return rows;
}

void add_triangles(mesh::MeshArrays boundary, MeshPiece& piece)
{
  const std::vector<LocalIndex> rows = rows_of(boundary.point_ids, piece.point_ids);
  piece.triangle_points.reserve(boundary.cell_points.size());
  for (const LocalIndex point : boundary.cell_points)
    piece.triangle_points.push_back(rows[at(point)]);
  for (const GlobalIndex tet : boundary.cell_longs["tet"]) {
    const auto row = std::ranges::lower_bound(piece.tet_ids, tet) - piece.tet_ids.begin();
    piece.triangle_tet.push_back(static_cast<LocalIndex>(row));
  }
  piece.triangle_ids = std::move(boundary.cell_ids);
  piece.triangle_patch = std::move(boundary.cell_ints["patch"]);
}

}  // namespace

MeshPiece mesh_piece(PieceArrays arrays, LocalIndex number)
{
  mesh::MeshArrays& tets = arrays.tets;
  MeshPiece piece;
  piece.number = number;
  piece.point_xyz = std::move(tets.point_xyz);
  piece.point_ids = std::move(tets.point_ids);
  piece.point_owner = std::move(tets.point_ints["owner"]);
  piece.tet_points = std::move(tets.cell_points);
  piece.tet_ids = std::move(tets.cell_ids);
  piece.tet_material = std::move(tets.cell_ints["attribute"]);
  piece.tet_subdomain = std::move(tets.cell_ints["subdomain"]);
  piece.material_names = std::move(tets.field_texts["material_names"]);
  piece.patch_names = std::move(tets.field_texts["patch_names"]);
  const std::vector<std::string>& unit = tets.field_texts["length_unit"];
  if (!unit.empty()) piece.length_unit = unit.front();
  add_triangles(std::move(arrays.boundary), piece);
  return piece;
}

}  // namespace tessera::subdomain
