// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/core_figures.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>

#include "tessera/mesh/tet_edges.hpp"
#include "tessera/number/shared_vertices.hpp"
#include "tessera/subdomain/measure_piece.hpp"

namespace tessera::subdomain {
namespace {

using Edge = std::array<LocalIndex, 2>;  // Ascending.

struct CutPiece {
  mesh::Piece core{};                    // With all vertices of the piece.
  std::vector<LocalIndex> outer_tets{};  // Shape (num_outer_tets, 4).
};

CutPiece cut_off_core(const improve::PiecePart& whole, const improve::PhaseBands& kept)
{
  std::vector<char> is_outer(at(whole.num_tet_tags), 0);
  for (const LocalIndex tag : kept.tet_tags.values) is_outer[at(tag)] = 1;
  for (const LocalIndex tag : kept.rim->tet_tag) is_outer[at(tag)] = 1;
  const mesh::Piece& piece = whole.piece;
  CutPiece cut{.core = {.subdomain = piece.subdomain,
                        .material = piece.material,
                        .vertex_xyz = piece.vertex_xyz,
                        .skin_host = piece.skin_host,
                        .skin_index = piece.skin_index}};
  for (std::size_t t = 0; t < whole.tet_tag.size(); ++t) {
    auto& tets = is_outer[at(whole.tet_tag[t])] != 0 ? cut.outer_tets : cut.core.tet_vertices;
    const LocalIndex* v = &piece.tet_vertices[4 * t];
    tets.insert(tets.end(), v, v + 4);
  }
  return cut;
}

std::vector<char> used_vertices(const std::vector<LocalIndex>& tets, LocalIndex num_vertices)
{
  std::vector<char> is_used(at(num_vertices), 0);
  for (const LocalIndex v : tets) is_used[at(v)] = 1;
  return is_used;
}

// Edges between marked vertices, ascending. Few tets have such edges, and only these are looked at.
std::vector<Edge> edges_between(const std::vector<char>& marks, const std::vector<LocalIndex>& tets)
{
  const auto is_marked = [&](LocalIndex v) { return marks[at(v)] != 0; };
  std::vector<LocalIndex> some;
  for (std::size_t i = 0; i < tets.size(); i += 4) {
    const LocalIndex* v = &tets[i];
    if (std::count_if(v, v + 4, is_marked) > 1) some.insert(some.end(), v, v + 4);
  }
  std::vector<Edge> edges;
  mesh::for_each_edge(some, static_cast<LocalIndex>(marks.size()), [&](LocalIndex a, LocalIndex b) {
    if (is_marked(a) && is_marked(b)) edges.push_back({a, b});
  });
  std::ranges::sort(edges);
  return edges;
}

void take_away(const std::vector<Edge>& edges, const mesh::Piece& piece,
               quality::QualityHistograms& histograms)
{
  quality::QualityHistograms of_edges;
  for (const auto& [a, b] : edges) measure_edge(piece, a, b, of_edges);
  histograms.log2_edge_length.subtract(of_edges.log2_edge_length);
}

// All of the core, but for inner ones that the outer part has as well.
void count_vertices(const CutPiece& cut, CoreFigures& core)
{
  const mesh::Piece& piece = cut.core;
  const auto in_core = used_vertices(piece.tet_vertices, piece.num_vertices());
  const auto in_outer = used_vertices(cut.outer_tets, piece.num_vertices());
  for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
    if (in_core[at(v)] == 0) continue;
    if (v < piece.num_skin_vertices()) {
      core.shared_vertices.push_back(piece.skin_point(v));
    } else if (in_outer[at(v)] == 0) {
      ++core.figures.summary.num_interior_vertices;
    }
  }
  std::ranges::sort(core.shared_vertices);
}

// An edge with an inner vertex stays in the outer part, which cannot lose that. One between shared
// vertices may go to another piece: who has it in the end is known then.
void count_edges(const CutPiece& cut, const std::vector<LocalIndex>& vertex_tag, CoreFigures& core)
{
  const mesh::Piece& piece = cut.core;
  std::vector<char> in_both = used_vertices(piece.tet_vertices, piece.num_vertices());
  const auto in_outer = used_vertices(cut.outer_tets, piece.num_vertices());
  std::ranges::transform(in_both, in_outer, in_both.begin(), std::bit_and<>());
  std::vector<Edge> common;
  std::ranges::set_intersection(edges_between(in_both, piece.tet_vertices),
                                edges_between(in_both, cut.outer_tets), std::back_inserter(common));
  const auto inner = std::partition(common.begin(), common.end(), [&](const Edge& edge) {
    return edge[1] < piece.num_skin_vertices();
  });
  measure_edges(piece, core.figures.histograms);
  take_away({inner, common.end()}, piece, core.figures.histograms);
  for (auto edge = common.begin(); edge != inner; ++edge) {
    core.shared_edges.push_back({vertex_tag[at((*edge)[0])], vertex_tag[at((*edge)[1])]});
  }
}

// Row of a shared vertex; kNoIndex if the part has not got it.
LocalIndex row_of_tag(LocalIndex tag, const improve::PiecePart& part)
{
  const auto tags = std::span(part.vertex_tag).first(at(part.piece.num_skin_vertices()));
  const auto found = std::ranges::lower_bound(tags, tag);
  if (found == tags.end() || *found != tag) return kNoIndex;
  return static_cast<LocalIndex>(found - tags.begin());
}

// The core's edges that the outer part still has.
std::vector<Edge> common_edges(const CoreFigures& core, const improve::PiecePart& outer)
{
  std::vector<Edge> wanted;
  std::vector<char> marks(at(outer.piece.num_vertices()), 0);
  for (const auto& [a, b] : core.shared_edges) {
    const auto [low, high] = std::minmax({row_of_tag(a, outer), row_of_tag(b, outer)});
    if (low == kNoIndex) continue;
    const Edge edge{low, high};
    wanted.push_back(edge);
    for (const LocalIndex v : edge) marks[at(v)] = 1;
  }
  std::ranges::sort(wanted);
  std::vector<Edge> common;
  std::ranges::set_intersection(wanted, edges_between(marks, outer.piece.tet_vertices),
                                std::back_inserter(common));
  return common;
}

}  // namespace

CoreFigures measure_core(const improve::PiecePart& whole, const improve::PhaseBands& kept,
                         const std::vector<char>& on_seam)
{
  const CutPiece cut = cut_off_core(whole, kept);
  CoreFigures core;
  PieceSummary& summary = core.figures.summary;
  summary.num_tets = cut.core.num_tets();
  summary.volume = volume_of(cut.core);
  summary.surface = verify::surface_hash(cut.core, whole.vertex_tag);
  measure_tets(cut.core, on_seam, core.figures);
  count_vertices(cut, core);
  count_edges(cut, whole.vertex_tag, core);
  return core;
}

void add_core(const CoreFigures& core, const improve::PiecePart& outer, FillResult& result)
{
  const PieceSummary& from = core.figures.summary;
  PieceSummary& to = result.summary;
  to.num_tets += from.num_tets;
  to.num_interior_vertices += from.num_interior_vertices;
  to.volume += from.volume;
  to.surface += from.surface;
  to.tets.add(from.tets);
  to.seam_tets.add(from.seam_tets);
  result.histograms.add(core.figures.histograms);
  take_away(common_edges(core, outer), outer.piece, result.histograms);
  result.worst.add(core.figures.worst);
}

std::vector<mesh::HostPoint> shared_vertices(const CoreFigures& core, const mesh::Piece& outer)
{
  std::vector<mesh::HostPoint> all;
  std::ranges::set_union(number::shared_vertices(outer), core.shared_vertices,
                         std::back_inserter(all));
  return all;
}

}  // namespace tessera::subdomain
