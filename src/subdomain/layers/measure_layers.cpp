// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layers/measure_layers.hpp"

#include <algorithm>
#include <cstddef>

#include "tessera/base/tet.hpp"
#include "tessera/subdomain/measure_piece.hpp"

namespace tessera::subdomain {
namespace {

// What layers stand on, without the tets and the vertices inside, which are many.
mesh::Piece without_tets(const mesh::Piece& piece)
{
  const auto end_of_skin = piece.vertex_xyz.begin() + 3 * std::ptrdiff_t{piece.num_skin_vertices()};
  return {.subdomain = piece.subdomain,
          .vertex_xyz = {piece.vertex_xyz.begin(), end_of_skin},
          .skin_host = piece.skin_host,
          .skin_index = piece.skin_index,
          .boundary_vertices = piece.boundary_vertices,
          .boundary_patch = piece.boundary_patch,
          .boundary_tet = piece.boundary_tet,
          .columns = piece.columns};
}

}  // namespace

void measure_layers(const mesh::Piece& piece, const LayerTables& tables, PieceSummary& summary)
{
  const LayeredPiece layered = with_layers(without_tets(piece), tables);
  summary.layers = {};
  for (LocalIndex t = 0; t < layered.piece.num_tets(); ++t) {
    const auto& [a, b, c, d] = layered.piece.corners(t);
    const double volume = tet_volume(a, b, c, d);
    summary.is_folded = summary.is_folded || !(volume > 0.0);
    summary.layers.volume += volume;
  }
  summary.boundary_area += layered.outside_area;
  summary.layers.num_tets = layered.piece.num_tets();
  summary.layers.num_cells = std::ranges::count(layered.tet_of_prism, 0);
  summary.num_boundary = std::ranges::count_if(
      piece.boundary_patch, [&](LocalIndex patch) { return !tables.is_hidden(patch); });
  summary.layers.num_side_triangles = layered.piece.num_boundary() - summary.num_boundary;
  summary.patches = patch_areas(layered.piece);
}

}  // namespace tessera::subdomain
