// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/count_pieces.hpp"

#include "tessera/fill/subdivide.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/subdomain/layer_tables.hpp"

namespace tessera::subdomain {

std::vector<number::PieceCounts> count_subdivided_pieces(const PartitionedMesh& cut,
                                                         const mesh::EdgeLevels& levels, int splits)
{
  const mesh::LatticeLevels of_skeleton = mesh::lattice_levels(cut.skeleton, levels);
  const auto layers = layer_tables(cut.coarse, cut.skeleton, of_skeleton, splits);
  std::vector<number::PieceCounts> counts;
  for (LocalIndex s = 0; s < cut.num_subdomains(); ++s) {
    const auto inside = fill::count_subdivision(
        mesh::tet_complex(cut.coarse, cut.skeleton, cut.tets[s]), cut.coarse, levels);
    number::PieceCounts& piece = counts.emplace_back(number::PieceCounts{
        .interior_vertices = inside.interior_vertices, .tets = inside.tets << 3 * splits});
    for (const LocalIndex t : cut.skeleton.triangles_of(s)) {
      const LocalIndex patch = cut.skeleton.triangle_patch[at(t)];
      if (patch == kNoIndex || cut.skeleton.triangle_owner(t) != s) continue;
      if (layers && layers->is_hidden(patch)) continue;
      piece.boundary_triangles += mesh::num_small_triangles(cut.skeleton, of_skeleton, t)
                                  << 2 * splits;
    }
    if (!layers) continue;
    piece.tets += layers->counts(s).tets;
    piece.boundary_triangles += layers->counts(s).side_triangles;
  }
  for (const LineEdge& line : cut.lines)
    counts[at(line.owner)].line_edges += GlobalIndex{of_skeleton.edge_intervals(line.edge)}
                                         << splits;
  return counts;
}

number::PieceCounts counts_of(const PieceSummary& piece)
{
  GlobalIndex line_edges = 0;
  for (const LineLength& line : piece.lines) line_edges += line.num_edges;
  return {.interior_vertices = piece.num_interior_vertices,
          .tets = piece.num_all_tets(),
          .boundary_triangles = piece.num_all_boundary(),
          .line_edges = line_edges,
          .owned_vertices = piece.num_owned_vertices};
}

std::vector<number::PieceCounts> counts_of(const std::vector<PieceSummary>& pieces)
{
  std::vector<number::PieceCounts> counts;
  for (const PieceSummary& piece : pieces) counts.push_back(counts_of(piece));
  return counts;
}

}  // namespace tessera::subdomain
