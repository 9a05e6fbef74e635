// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/measure_piece.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "tessera/mesh/tet_edges.hpp"

namespace tessera::subdomain {

GlobalIndex measure_edges(const mesh::Piece& piece, quality::QualityHistograms& histograms)
{
  const std::span<const double> xyz(piece.vertex_xyz);
  GlobalIndex num_edges = 0;
  mesh::for_each_edge(piece.tet_vertices, piece.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    ++num_edges;
    const Vec3 edge = point_at(xyz, b) - point_at(xyz, a);
    // Single precision is a thousand times finer than a bin, and 1.1 to 1.5 times as fast.
    const auto squared_length = static_cast<float>(dot(edge, edge));
    histograms.log2_edge_length.add(0.5 * static_cast<double>(std::log2(squared_length)));
  });
  return num_edges;
}

void measure_tets(const mesh::Piece& piece, const std::vector<char>& on_seam, FillResult& result)
{
  const auto is_on_seam = [&](LocalIndex v) {
    return v < piece.num_skin_vertices() && on_seam[at(v)] != 0;
  };
  quality::ShapeSum all(result.histograms.mean_ratio);
  quality::ShapeSum on_seams(result.histograms.seam_mean_ratio);
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const quality::TetShape shape = quality::shape_of(piece.corners(t));
    all.add(shape);
    const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
    if (std::any_of(v, v + 4, is_on_seam)) on_seams.add(shape);
  }
  result.summary.tets = all.statistics();
  result.summary.seam_tets = on_seams.statistics();
}

}  // namespace tessera::subdomain
