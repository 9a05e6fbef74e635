// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/places.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "tessera/base/error.hpp"
#include "tessera/mesh/half_edges.hpp"
#include "tessera/surface/overlap.hpp"

namespace tessera::surface {
namespace {

void count_at(std::size_t triangle, PlaceKind kind, SurfacePlaces& found)
{
  ++found.triangle_counts[kNumPlaceKinds * triangle + static_cast<std::size_t>(kind)];
}

void add_edges(const model::TriangleSurface& surface, PlaceKind kind, SurfacePlaces& found)
{
  const IndexLists edges = mesh::half_edges_of_edges(surface.triangle_vertices);
  for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
    const std::size_t num_triangles = edges[e].size();
    const bool is_one = kind == PlaceKind::open_edge ? num_triangles == 1 : num_triangles > 2;
    if (!is_one) continue;
    const LocalIndex h = edges[e][0];
    found.places.push_back(
        {kind, surface.position(surface.triangle_vertices[at(h)]),
         surface.position(surface.triangle_vertices[at(mesh::next_in_triangle(h))])});
    for (const LocalIndex half_edge : edges[e]) count_at(at(half_edge / 3), kind, found);
  }
}

void add_crossings(const model::TriangleSurface& surface, SurfacePlaces& found)
{
  PatchSurface triangles;
  for (LocalIndex v = 0; v < surface.num_vertices(); ++v)
    triangles.vertex_xyz.push_back(surface.position(v));
  for (std::size_t t = 0; t < found.num_triangles(); ++t) {
    const LocalIndex* const v = &surface.triangle_vertices[3 * t];
    triangles.triangles.push_back({v[0], v[1], v[2]});
  }
  for (const auto& [first, second, place] : find_overlaps(triangles)) {
    found.places.push_back({PlaceKind::crossing, place, place});
    count_at(first, PlaceKind::crossing, found);
    count_at(second, PlaceKind::crossing, found);
  }
}

}  // namespace

std::string words_of(PlaceKind kind)
{
  switch (kind) {
    case PlaceKind::open_edge:
      return "edges with one triangle";
    case PlaceKind::crowded_edge:
      return "edges with more than two triangles";
    case PlaceKind::crossing:
      break;
  }
  return "pairs of triangles that cut each other";
}

std::size_t SurfacePlaces::count(PlaceKind kind) const
{
  return static_cast<std::size_t>(std::ranges::count(places, kind, &Place::kind));
}

void SurfacePlaces::require_sound() const
{
  const std::size_t num_vertices = vertex_xyz.size() / 3;
  const bool is_sound =
      vertex_xyz.size() % 3 == 0 && triangle_vertices.size() % 3 == 0
      && triangle_counts.size() == kNumPlaceKinds * num_triangles()
      && std::ranges::all_of(triangle_vertices,
                             [&](LocalIndex v) { return v >= 0 && at(v) < num_vertices; })
      && std::ranges::all_of(triangle_counts, [](std::int32_t count) { return count >= 0; });
  if (!is_sound) throw InputError("record of places of a surface is damaged");
}

SurfacePlaces find_places(const model::TriangleSurface& surface)
{
  SurfacePlaces found{.vertex_xyz = surface.vertex_xyz,
                      .triangle_vertices = surface.triangle_vertices};
  found.triangle_counts.resize(kNumPlaceKinds * found.num_triangles());
  add_edges(surface, PlaceKind::open_edge, found);
  add_edges(surface, PlaceKind::crowded_edge, found);
  add_crossings(surface, found);
  return found;
}

}  // namespace tessera::surface
