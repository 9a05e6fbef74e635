// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/surface_simplices.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "number/compare_keys.hpp"

namespace tessera::number {
namespace {

using mesh::HostKind;

template <class Key>
using List = std::vector<Key> SurfaceSimplices::*;

template <class Key>
std::vector<char> compare(const SurfaceList& own, std::span<const SurfaceList> neighbours,
                          List<Key> list, SurfaceSimplices& owned)
{
  const auto keys_of = [list](const SurfaceList& piece) {
    return NeighbourKeys<Key>{piece.subdomain, piece.material, piece.simplices.*list};
  };
  std::vector<NeighbourKeys<Key>> others;
  for (const SurfaceList& other : neighbours) others.push_back(keys_of(other));
  return compare_keys(keys_of(own), others, owned.*list);
}

GlobalIndex count(std::size_t num_simplices, HostKind kind, LocalIndex n)
{
  return static_cast<GlobalIndex>(num_simplices) * mesh::num_points_of_host(kind, n);
}

// Where the points of one list begin among those that a piece owns.
GlobalIndex first_point(const SurfaceSimplices& owned, HostKind kind, LocalIndex n)
{
  if (kind == HostKind::vertex) return 0;
  const GlobalIndex num_vertices = count(owned.vertices.size(), HostKind::vertex, n);
  if (kind == HostKind::edge) return num_vertices;
  return num_vertices + count(owned.edges.size(), HostKind::edge, n);
}

// Every simplex of one kind has one owner: who finds it, places it.
template <class Key>
std::vector<SimplexPlace> find(const std::vector<Key>& own, std::span<const OwnedSurface> owners,
                               List<Key> list, HostKind kind, LocalIndex n)
{
  std::vector<SimplexPlace> places(own.size());
  const LocalIndex points_each = mesh::num_points_of_host(kind, n);
  for (const OwnedSurface& owner : owners) {
    const std::vector<Key>& owned = owner.simplices.*list;
    const auto first = static_cast<LocalIndex>(first_point(owner.simplices, kind, n));
    auto next = owned.begin();
    for (std::size_t k = 0; k < own.size(); ++k) {
      next = std::lower_bound(next, owned.end(), own[k]);
      if (next == owned.end()) break;
      if (*next != own[k]) continue;
      const auto row = static_cast<LocalIndex>(next - owned.begin());
      places[k] = {owner.subdomain, first + row * points_each};
    }
  }
  return places;
}

void require_owners(const std::vector<SimplexPlace>& places, const char* what)
{
  const auto lost = std::ranges::find(places, kNoIndex, &SimplexPlace::owner);
  if (lost == places.end()) return;
  throw MeshError(
      fmt::format("nobody owns {} {} of a piece's surface", what, lost - places.begin()));
}

}  // namespace

GlobalIndex SurfaceSimplices::num_points(LocalIndex n) const
{
  return count(vertices.size(), HostKind::vertex, n) + count(edges.size(), HostKind::edge, n)
         + count(triangles.size(), HostKind::triangle, n);
}

SharedSurface compare_surfaces(const SurfaceList& own, std::span<const SurfaceList> neighbours)
{
  SharedSurface shared;
  shared.vertex_on_seam = compare(own, neighbours, &SurfaceSimplices::vertices, shared.owned);
  shared.edge_on_seam = compare(own, neighbours, &SurfaceSimplices::edges, shared.owned);
  shared.triangle_on_seam = compare(own, neighbours, &SurfaceSimplices::triangles, shared.owned);
  return shared;
}

SurfacePlaces place_surface(const SurfaceSimplices& own, std::span<const OwnedSurface> owners,
                            LocalIndex n)
{
  SurfacePlaces places = find_places(own, owners, n);
  require_owners(places.vertices, "vertex");
  require_owners(places.edges, "edge");
  require_owners(places.triangles, "triangle");
  return places;
}

SurfacePlaces find_places(const SurfaceSimplices& simplices, std::span<const OwnedSurface> owners,
                          LocalIndex n)
{
  return {find(simplices.vertices, owners, &SurfaceSimplices::vertices, HostKind::vertex, n),
          find(simplices.edges, owners, &SurfaceSimplices::edges, HostKind::edge, n),
          find(simplices.triangles, owners, &SurfaceSimplices::triangles, HostKind::triangle, n)};
}

}  // namespace tessera::number
