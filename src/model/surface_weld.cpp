// SPDX-License-Identifier: BSD-3-Clause
#include "surface_weld.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

#include "tessera/base/union_find.hpp"
#include "tessera/mesh/half_edges.hpp"

namespace tessera::model {
namespace {

// Vertices of edges with one triangle, ascending.
std::vector<LocalIndex> open_vertices(const TriangleSurface& surface)
{
  const IndexLists edges = mesh::half_edges_of_edges(surface.triangle_vertices);
  std::vector<LocalIndex> vertices;
  for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
    if (edges[e].size() != 1) continue;
    const LocalIndex h = edges[e][0];
    vertices.push_back(surface.triangle_vertices[at(h)]);
    vertices.push_back(surface.triangle_vertices[at(mesh::next_in_triangle(h))]);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void drop_unused_vertices(TriangleSurface& surface)
{
  std::vector<LocalIndex> old_to_new_vertex(at(surface.num_vertices()), kNoIndex);
  std::vector<double> vertex_xyz;
  for (LocalIndex& v : surface.triangle_vertices) {
    LocalIndex& renumbered = old_to_new_vertex[at(v)];
    if (renumbered == kNoIndex) {
      renumbered = static_cast<LocalIndex>(vertex_xyz.size() / 3);
      const Vec3 p = surface.position(v);
      vertex_xyz.insert(vertex_xyz.end(), p.begin(), p.end());
    }
    v = renumbered;
  }
  surface.vertex_xyz = std::move(vertex_xyz);
}

bool is_degenerate(const LocalIndex* v) { return v[0] == v[1] || v[1] == v[2] || v[2] == v[0]; }

// A place in each set of triangles that hang together, at least as many as bound a body, and are
// all degenerate.
std::vector<Vec3> bodies_without_size(const TriangleSurface& surface)
{
  constexpr LocalIndex kLeast = 4;
  UnionFind joined(surface.num_vertices());
  for (std::size_t c = 0; c < surface.triangle_vertices.size(); ++c) {
    joined.join(surface.triangle_vertices[c - c % 3], surface.triangle_vertices[c]);
  }
  std::vector<LocalIndex> num_triangles(at(surface.num_vertices()), 0);
  std::vector<bool> has_sound(at(surface.num_vertices()), false);
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const LocalIndex* const v = &surface.triangle_vertices[3 * at(t)];
    const std::size_t body = at(joined.find(v[0]));
    ++num_triangles[body];
    if (!is_degenerate(v)) has_sound[body] = true;
  }
  std::vector<Vec3> places;
  for (LocalIndex v = 0; v < surface.num_vertices(); ++v) {
    if (num_triangles[at(v)] >= kLeast && !has_sound[at(v)]) places.push_back(surface.position(v));
  }
  return places;
}

}  // namespace

TriangleSurface weld_equal_corners(const TriangleSoup& soup)
{
  const std::span<const double> corner_xyz(soup.corner_xyz);
  std::vector<LocalIndex> sorted(soup.corner_xyz.size() / 3);
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](LocalIndex a, LocalIndex b) {
    return std::pair(point_at(corner_xyz, a), a) < std::pair(point_at(corner_xyz, b), b);
  });

  TriangleSurface surface;
  surface.vertex_xyz = soup.corner_xyz;
  surface.triangle_vertices.resize(sorted.size());
  surface.triangle_solid = soup.triangle_solid;
  surface.solid_names = soup.solid_names;
  LocalIndex first = 0;  // lowest corner at the position of the one looked at
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || point_at(corner_xyz, sorted[i]) != point_at(corner_xyz, first)) first = sorted[i];
    surface.triangle_vertices[at(sorted[i])] = first;
  }
  drop_unused_vertices(surface);
  return surface;
}

LocalIndex weld_open_vertices(TriangleSurface& surface, double tolerance)
{
  // Near points are near along any direction, so one direction is enough to find them. On an axis
  // all points of a flat side may coincide; along this direction they do not, so few pairs have to
  // be looked at.
  constexpr Vec3 kDirection{0.4082, 0.5345, 0.7401};
  const auto along = [&](LocalIndex v) { return dot(kDirection, surface.position(v)); };
  std::vector<LocalIndex> open = open_vertices(surface);
  std::sort(open.begin(), open.end(), [&](LocalIndex a, LocalIndex b) {
    return std::pair(along(a), a) < std::pair(along(b), b);
  });
  UnionFind welded(surface.num_vertices());
  LocalIndex num_joined = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (std::size_t j = i + 1; j < open.size(); ++j) {
      if (along(open[j]) - along(open[i]) > tolerance) break;
      if (norm(surface.position(open[j]) - surface.position(open[i])) > tolerance) continue;
      if (welded.join(open[i], open[j])) ++num_joined;
    }
  }
  for (LocalIndex& v : surface.triangle_vertices) v = welded.find(v);
  return num_joined;
}

DroppedTriangles drop_bad_triangles(TriangleSurface& surface)
{
  DroppedTriangles dropped{.bodies = bodies_without_size(surface)};
  std::set<std::array<LocalIndex, 3>> seen;
  LocalIndex kept = 0;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const auto vertices = surface.triangle_vertices.begin() + 3 * std::ptrdiff_t{t};
    std::array<LocalIndex, 3> key{vertices[0], vertices[1], vertices[2]};
    std::sort(key.begin(), key.end());
    const bool degenerate = key[0] == key[1] || key[1] == key[2];
    if (degenerate) {
      ++dropped.degenerate;
    } else if (!seen.insert(key).second) {
      ++dropped.repeated;
    } else {
      std::copy_n(vertices, 3, surface.triangle_vertices.begin() + 3 * std::ptrdiff_t{kept});
      surface.triangle_solid[at(kept++)] = surface.triangle_solid[at(t)];
    }
  }
  surface.triangle_vertices.resize(3 * at(kept));
  surface.triangle_solid.resize(at(kept));
  drop_unused_vertices(surface);
  return dropped;
}

}  // namespace tessera::model
