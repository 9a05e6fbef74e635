// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_surface.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/number/shared_vertices.hpp"

namespace tessera::subdomain {
namespace {

std::array<mesh::HostPoint, 3> names_of(const mesh::Piece& piece,
                                        const std::array<LocalIndex, 3>& triangle)
{
  std::array<mesh::HostPoint, 3> names;
  for (std::size_t c = 0; c < 3; ++c) {
    if (triangle[c] >= piece.num_skin_vertices()) {
      throw MeshError(fmt::format("vertex {} of piece {} is on its surface and has no name",
                                  triangle[c], piece.subdomain));
    }
    names[c] = piece.skin_point(triangle[c]);
  }
  std::ranges::sort(names);
  return names;
}

// Which of the piece's vertices lie on a seam.
std::vector<char> vertices_on_seams(const mesh::Piece& piece, const number::SurfaceList& surface,
                                    const number::SharedSurface& shared)
{
  const std::vector<mesh::HostPoint>& names = surface.simplices.vertices;
  std::vector<char> on_seam(at(piece.num_vertices()), 0);
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const auto row = std::ranges::lower_bound(names, piece.skin_point(v)) - names.begin();
    on_seam[at(v)] = shared.vertex_on_seam[static_cast<std::size_t>(row)];
  }
  return on_seam;
}

// The vertices of `piece` that are flagged, in their order; `number` gets their new numbers.
void copy_vertices(const mesh::Piece& piece, const std::vector<char>& is_used, mesh::Piece& to,
                   std::vector<LocalIndex>& number)
{
  for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
    if (is_used[at(v)] == 0) continue;
    number[at(v)] = to.num_vertices();
    const Vec3 position = point_at(std::span(piece.vertex_xyz), v);
    to.vertex_xyz.insert(to.vertex_xyz.end(), position.begin(), position.end());
    if (v >= piece.num_skin_vertices()) continue;
    to.skin_host.push_back(piece.skin_host[at(v)]);
    to.skin_index.push_back(piece.skin_index[at(v)]);
  }
}

// The tets with a flagged vertex, in their order, without boundary triangles.
mesh::Piece tets_touching(const mesh::Piece& piece, const std::vector<char>& is_flagged)
{
  std::vector<char> is_used(at(piece.num_vertices()), 0);
  std::vector<LocalIndex> tets;
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
    if (std::none_of(v, v + 4, [&](LocalIndex i) { return is_flagged[at(i)] != 0; })) continue;
    tets.push_back(t);
    for (std::size_t c = 0; c < 4; ++c) is_used[at(v[c])] = 1;
  }
  mesh::Piece some{.subdomain = piece.subdomain, .material = piece.material};
  std::vector<LocalIndex> number(at(piece.num_vertices()), kNoIndex);
  copy_vertices(piece, is_used, some, number);
  for (const LocalIndex t : tets) {
    for (std::size_t c = 0; c < 4; ++c) {
      some.tet_vertices.push_back(number[at(piece.tet_vertices[4 * at(t) + c])]);
    }
  }
  return some;
}

// With n intervals an edge.
GlobalIndex num_interior_points(const mesh::Piece& piece, const number::SurfaceSimplices& surface,
                                LocalIndex n)
{
  const auto num_on_surface = [](const auto& simplices) {
    return static_cast<GlobalIndex>(simplices.size());
  };
  const GlobalIndex num_tets = piece.num_tets();
  const GlobalIndex on_surface = num_on_surface(surface.triangles);
  const GlobalIndex vertices = piece.num_vertices() - num_on_surface(surface.vertices);
  const GlobalIndex edges =
      mesh::count_edges(piece.tet_vertices, piece.num_vertices()) - num_on_surface(surface.edges);
  const GlobalIndex triangles = (4 * num_tets - on_surface) / 2;
  return vertices + edges * mesh::num_points_of_host(mesh::HostKind::edge, n)
         + triangles * mesh::num_points_of_host(mesh::HostKind::triangle, n)
         + num_tets * mesh::lattice::num_inner_tet_points(n);
}

}  // namespace

number::SurfaceList surface_of(const mesh::Piece& piece)
{
  number::SurfaceList list{.subdomain = piece.subdomain, .material = piece.material};
  number::SurfaceSimplices& simplices = list.simplices;
  simplices.vertices = number::shared_vertices(piece);
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(piece.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const auto [a, b, c] = names_of(piece, triangle.vertices);
    simplices.triangles.push_back({a, b, c});
    for (const auto& edge : {std::array{a, b}, std::array{a, c}, std::array{b, c}}) {
      simplices.edges.push_back(edge);
    }
  }
  std::ranges::sort(simplices.triangles);
  sort_unique(simplices.edges);
  return list;
}

mesh::Piece halo_of(const mesh::Piece& piece, const number::SurfaceList& surface,
                    const number::SharedSurface& shared)
{
  return tets_touching(piece, vertices_on_seams(piece, surface, shared));
}

mesh::Piece halo_beside(const mesh::Piece& halo, const number::SurfaceList& surface)
{
  std::vector<char> is_shared(at(halo.num_vertices()), 0);
  for (LocalIndex v = 0; v < halo.num_skin_vertices(); ++v) {
    is_shared[at(v)] =
        std::ranges::binary_search(surface.simplices.vertices, halo.skin_point(v)) ? 1 : 0;
  }
  return tets_touching(halo, is_shared);
}

number::PieceCounts count_split_piece(const mesh::Piece& piece, const number::SurfaceList& surface,
                                      const number::SharedSurface& shared, const PieceSplit& split,
                                      const LayerTables* layers)
{
  const LocalIndex n = mesh::lattice::intervals(split.levels);
  const GlobalIndex num_interior = num_interior_points(piece, surface.simplices, n);
  number::PieceCounts counts{
      .interior_vertices = num_interior,
      .tets = GlobalIndex{piece.num_tets()} * (split.is_curved ? 1 : GlobalIndex{n} * n * n),
      .boundary_triangles = GlobalIndex{piece.num_boundary()} * (split.is_curved ? 1 : n * n),
      .line_edges = GlobalIndex{piece.num_line_edges()} * (split.is_curved ? 1 : n),
      .owned_vertices = num_interior + shared.owned.num_points(n)};
  if (layers == nullptr) return counts;
  const auto num_hidden = std::ranges::count_if(
      piece.boundary_patch, [&](LocalIndex patch) { return layers->is_hidden(patch); });
  const LayerCounts& more = layers->counts(piece.subdomain);
  counts.tets += more.tets;
  counts.boundary_triangles += more.side_triangles - num_hidden * n * n;
  return counts;
}

number::SurfaceSimplices ends_across_joints(const number::SurfaceSimplices& surface,
                                            const LayerTables& layers)
{
  number::SurfaceSimplices ends;
  const auto add_others = [&](const auto& simplices, auto& others) {
    for (auto simplex : simplices) {
      const auto before = simplex;
      for (mesh::HostPoint& name : simplex) name = layers.end_at_tets(name);
      if (simplex == before) continue;
      std::ranges::sort(simplex);
      others.push_back(simplex);
    }
    sort_unique(others);
  };
  for (const mesh::HostPoint& name : surface.vertices) {
    const mesh::HostPoint end = layers.end_at_tets(name);
    if (end != name) ends.vertices.push_back(end);
  }
  sort_unique(ends.vertices);
  add_others(surface.edges, ends.edges);
  add_others(surface.triangles, ends.triangles);
  return ends;
}

std::vector<VertexPlace> places_of_split_names(std::span<const mesh::HostPoint> names,
                                               const mesh::HostLayout& hosts)
{
  std::vector<VertexPlace> places;
  for (const mesh::HostPoint& name : names) {
    places.push_back({hosts.row_of(name.host), name.index});
  }
  return places;
}

std::vector<VertexPlace> places_of_split_piece(const mesh::Piece& piece,
                                               const mesh::HostLayout& hosts,
                                               const number::PieceCounts& counts)
{
  std::vector<mesh::HostPoint> names;
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) names.push_back(piece.skin_point(v));
  std::vector<VertexPlace> places = places_of_split_names(names, hosts);
  places.reserve(at(piece.num_vertices()));
  auto next = static_cast<LocalIndex>(counts.owned_vertices - counts.interior_vertices);
  for (LocalIndex v = piece.num_skin_vertices(); v < piece.num_vertices(); ++v) {
    places.push_back({piece.subdomain, next++});
  }
  return places;
}

}  // namespace tessera::subdomain
