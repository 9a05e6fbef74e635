// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/core_figures.hpp"

#include <algorithm>

#include "tessera/subdomain/measure_piece.hpp"

namespace tessera::subdomain {
namespace {

// By tet of the piece.
std::vector<char> core_tets(const mesh::Piece& piece, const improve::PhaseBands& kept)
{
  std::vector<char> is_core(at(piece.num_tets()), 1);
  for (const LocalIndex t : kept.tet_tags.values) is_core[at(t)] = 0;
  for (const LocalIndex t : kept.rim->tet_tag) is_core[at(t)] = 0;
  return is_core;
}

// Those with that mark, and all vertices.
mesh::Piece with_some_tets(const mesh::Piece& piece, const std::vector<char>& marks, char mark)
{
  mesh::Piece some{.subdomain = piece.subdomain,
                   .material = piece.material,
                   .vertex_xyz = piece.vertex_xyz,
                   .skin_host = piece.skin_host,
                   .skin_index = piece.skin_index};
  for (std::size_t t = 0; t < marks.size(); ++t) {
    if (marks[t] != mark) continue;
    const LocalIndex* v = &piece.tet_vertices[4 * t];
    some.tet_vertices.insert(some.tet_vertices.end(), v, v + 4);
  }
  return some;
}

// Those that the outer part has not got.
void find_core_vertices(const mesh::Piece& outer, CoreFigures& core)
{
  std::vector<char> is_outer(at(outer.num_vertices()), 0);
  for (const LocalIndex v : outer.tet_vertices) is_outer[at(v)] = 1;
  const auto first_inner = is_outer.begin() + outer.num_skin_vertices();
  core.figures.summary.num_interior_vertices = std::count(first_inner, is_outer.end(), 0);
  for (LocalIndex v = 0; v < outer.num_skin_vertices(); ++v) {
    if (is_outer[at(v)] == 0) core.shared_vertices.push_back(outer.skin_point(v));
  }
  std::ranges::sort(core.shared_vertices);
}

}  // namespace

CoreFigures measure_core(const FilledPiece& filled, const improve::PhaseBands& kept)
{
  const mesh::Piece& piece = filled.piece;
  const std::vector<char> is_core = core_tets(piece, kept);
  CoreFigures core;
  FillResult& figures = core.figures;
  {
    const mesh::Piece outer = with_some_tets(piece, is_core, 0);
    find_core_vertices(outer, core);
    quality::QualityHistograms of_outer;
    measure_edges(outer, of_outer);
    figures.histograms.log2_edge_length = filled.result.histograms.log2_edge_length;
    figures.histograms.log2_edge_length.subtract(of_outer.log2_edge_length);
  }
  const mesh::Piece inner = with_some_tets(piece, is_core, 1);
  figures.summary.num_tets = inner.num_tets();
  figures.summary.volume = volume_of(inner);
  figures.summary.surface = verify::surface_hash(inner);
  measure_tets(inner, std::vector<char>(at(inner.num_skin_vertices()), 0), figures);
  return core;
}

void add_core(const CoreFigures& core, FillResult& outer)
{
  const PieceSummary& from = core.figures.summary;
  PieceSummary& to = outer.summary;
  to.num_tets += from.num_tets;
  to.num_interior_vertices += from.num_interior_vertices;
  to.volume += from.volume;
  to.surface += from.surface;
  to.tets.add(from.tets);
  outer.histograms.add(core.figures.histograms);
  outer.worst.add(core.figures.worst);
}

}  // namespace tessera::subdomain
