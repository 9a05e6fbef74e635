// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/geometry_places.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>

namespace tessera::subdomain {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;

constexpr std::size_t kHostsOfTriangle = 7;  // Itself, its edges and its vertices.

// Triangles on the geometry by host of the skeleton.
IndexLists triangles_by_host(const mesh::Skeleton& skeleton, const mesh::HostLayout& hosts)
{
  std::vector<LocalIndex> keys;
  keys.reserve(kHostsOfTriangle * at(skeleton.num_triangles()));
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const bool is_on_geometry = skeleton.triangle_patch[at(t)] != kNoIndex;
    const auto push = [&](LocalIndex host) { keys.push_back(is_on_geometry ? host : kNoIndex); };
    push(hosts.triangle(t));
    for (std::size_t c = 0; c < 3; ++c) {
      push(hosts.edge(skeleton.triangle_edges[3 * at(t) + c]));
      push(hosts.vertex(skeleton.triangle_vertices[3 * at(t) + c]));
    }
  }
  return rows_by_key(keys, hosts.num_on_skeleton(), kHostsOfTriangle);
}

// Local vertex with this name; kNoIndex: none of these has it.
LocalIndex vertex_named(const std::vector<mesh::HostPoint>& names, const mesh::HostPoint& name)
{
  const auto found = std::ranges::lower_bound(names, name);
  const bool is_there = found != names.end() && *found == name;
  return is_there ? static_cast<LocalIndex>(found - names.begin()) : kNoIndex;
}

struct LatticeVertex {
  LocalIndex vertex = kNoIndex;  // Of the complex.
  TrianglePoint point{};
};

bool by_vertex(const LatticeVertex& a, const LatticeVertex& b) { return a.vertex < b.vertex; }

void place_edge(LocalIndex row, const mesh::Complex& complex, LatticeVertex a, LatticeVertex b,
                std::vector<GeometryPlace>& places)
{
  if (a.vertex == kNoIndex || b.vertex == kNoIndex) return;
  if (b.vertex < a.vertex) std::swap(a, b);
  const LocalIndex edge = mesh::find_edge(complex, {a.vertex, b.vertex});
  if (edge == kNoIndex || places[at(edge)].is_on_geometry()) return;
  places[at(edge)] = {row, {a.point, b.point}};
}

void place_triangle(LocalIndex row, const mesh::Complex& complex,
                    std::array<LatticeVertex, 3> corners, std::vector<GeometryPlace>& places)
{
  std::ranges::sort(corners, by_vertex);
  if (corners[0].vertex == kNoIndex) return;
  const LocalIndex triangle =
      mesh::find_triangle(complex, {corners[0].vertex, corners[1].vertex, corners[2].vertex});
  if (triangle == kNoIndex) return;
  places[at(triangle)] = {row, {corners[0].point, corners[1].point, corners[2].point}};
}

mesh::LatticeLevels same_levels(const mesh::Complex& complex, int levels)
{
  const auto level = static_cast<std::int8_t>(levels);
  return {.edges = std::vector(at(complex.num_edges()), level),
          .triangles = std::vector(at(complex.num_triangles()), level)};
}

// Fills the lattice of a complex, edges before triangles.
class MidpointLattice {
 public:
  MidpointLattice(const mesh::Complex& complex, const KnownPoints& known, int levels)
      : complex_(complex),
        known_(known),
        n_(lattice::intervals(levels)),
        result_(same_levels(complex, levels))
  {
  }

  mesh::RefinedLattice run(std::span<const double> vertex_xyz)
  {
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) fill_edge(e, vertex_xyz);
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) fill_triangle(t);
    return std::move(result_);
  }

 private:
  // Whether a point of a simplex in this place is not its own midpoint.
  [[nodiscard]] bool is_known(const GeometryPlace& place, LocalIndex i, LocalIndex j) const
  {
    if (!place.is_on_geometry() || place.triangle >= known_.places.num_known) return false;
    const LocalIndex triangle = known_.places.triangles[at(place.triangle)];
    const LocalIndex n = known_.lattice.triangle_intervals(place.triangle);
    return known_.limiter.factor(key_of(known_.skeleton, triangle, n, place.point(n_, i, j))) > 0.0;
  }

  [[nodiscard]] Vec3 known_point(const GeometryPlace& place, LocalIndex i, LocalIndex j) const
  {
    return known_.lattice.triangle_point(place.triangle, place.point(n_, i, j));
  }

  void fill_edge(LocalIndex e, std::span<const double> vertex_xyz)
  {
    for (const LocalIndex end : {0, 1}) {
      result_.place_edge_point(e, end * n_,
                               point_at(vertex_xyz, complex_.edge_vertices[2 * at(e) + at(end)]));
    }
    const GeometryPlace& place = known_.places.edges[at(e)];
    for (LocalIndex step = n_ / 2; step >= 1; step /= 2) {
      for (LocalIndex k = step; k < n_; k += 2 * step) {
        result_.place_edge_point(e, k,
                                 is_known(place, k, 0) ? known_point(place, k, 0)
                                                       : midpoint(result_.edge_point(e, k - step),
                                                                  result_.edge_point(e, k + step)));
      }
    }
  }

  void fill_triangle(LocalIndex t)
  {
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = 0; k <= n_; ++k) {
        result_.place_triangle_point(
            t, lattice::side_point(n_, side, k),
            result_.edge_point(complex_.triangle_edges[3 * at(t) + side], k));
      }
    }
    for (LocalIndex step = n_ / 2; step >= 1; step /= 2) {
      for (LocalIndex j = step; j < n_; j += step) {
        for (LocalIndex i = step; i + j < n_; i += step) {
          if ((i / step) % 2 != 0 || (j / step) % 2 != 0) fill_inner_point(t, {i, j}, step);
        }
      }
    }
  }

  void fill_inner_point(LocalIndex t, const TrianglePoint& p, LocalIndex step)
  {
    const GeometryPlace& place = known_.places.of_triangles[at(t)];
    if (is_known(place, p.i, p.j)) {
      result_.place_triangle_point(t, p, known_point(place, p.i, p.j));
      return;
    }
    const auto [a, b] = lattice::parents(p, step);
    result_.place_triangle_point(
        t, p, midpoint(result_.triangle_point(t, a), result_.triangle_point(t, b)));
  }

  const mesh::Complex& complex_;
  const KnownPoints& known_;
  LocalIndex n_;
  mesh::RefinedLattice result_;
};

}  // namespace

TrianglePoint GeometryPlace::point(LocalIndex n, LocalIndex i, LocalIndex j) const
{
  return lattice::SmallTriangle{corners[0], corners[1], corners[2]}.point(n, {i, j});
}

GeometryFinder::GeometryFinder(const PartitionedMesh& cut)
    : skeleton_(cut.skeleton),
      coarse_(cut.coarse),
      levels_(mesh::lattice_levels(cut.skeleton, cut.levels)),
      hosts_(cut.skeleton),
      triangles_of_host_(triangles_by_host(cut.skeleton, hosts_)),
      lines_(cut.lines)
{
}

// Those of which two or more of the lattice's points are there: others have no edge in common with
// the tets.
std::vector<LocalIndex> GeometryFinder::triangles_around(
    const std::vector<mesh::HostPoint>& names) const
{
  std::map<LocalIndex, int> num_points;
  for (const mesh::HostPoint& name : names) {
    if (name.host >= hosts_.num_on_skeleton()) continue;
    for (const LocalIndex t : triangles_of_host_[name.host]) ++num_points[t];
  }
  std::vector<LocalIndex> triangles;
  for (const auto& [triangle, count] : num_points) {
    if (count > 1) triangles.push_back(triangle);
  }
  return triangles;
}

// Of a point in a lattice with n intervals; without host if no piece has such a point.
mesh::HostPoint GeometryFinder::name_of(LocalIndex triangle, LocalIndex n,
                                        const TrianglePoint& p) const
{
  const auto [part, row, k] = lattice::place_of(n, p);
  if (part == lattice::PointPlace::Part::corner) {
    return {hosts_.vertex(skeleton_.triangle_vertices[3 * at(triangle) + row]), 0};
  }
  if (part == lattice::PointPlace::Part::side) {
    const LocalIndex e = skeleton_.triangle_edges[3 * at(triangle) + row];
    const LocalIndex step = n / levels_.edge_intervals(e);
    if (k % step != 0) return {kNoIndex, 0};
    return {hosts_.edge(e), k / step - 1};
  }
  const LocalIndex own = levels_.triangle_intervals(triangle);
  const LocalIndex step = n / own;
  if (p.i % step != 0 || p.j % step != 0) return {kNoIndex, 0};
  return {hosts_.triangle(triangle), lattice::inner_triangle_index(own, p.i / step, p.j / step)};
}

int GeometryFinder::level_of(LocalIndex triangle) const
{
  const LocalIndex* sides = &skeleton_.triangle_edges[3 * at(triangle)];
  return std::max({levels_.edge(sides[0]), levels_.edge(sides[1]), levels_.edge(sides[2])});
}

void GeometryFinder::place_lattice(LocalIndex row, const mesh::Complex& complex,
                                   const std::vector<mesh::HostPoint>& names,
                                   GeometryPlaces& places) const
{
  const LocalIndex triangle = places.triangles[at(row)];
  const mesh::TriangleGrading grading = grading_of(triangle);
  const LocalIndex n = grading.finest_intervals();
  std::vector<LatticeVertex> vertices(at(lattice::num_triangle_points(n)));
  for (LocalIndex j = 0; j <= n; ++j) {
    for (LocalIndex i = 0; i + j <= n; ++i) {
      const mesh::HostPoint name = name_of(triangle, n, {i, j});
      vertices[at(lattice::triangle_index(n, i, j))] = {vertex_named(names, name), {i, j}};
    }
  }
  const auto at_point = [&](const TrianglePoint& p) {
    return vertices[at(lattice::triangle_index(n, p.i, p.j))];
  };
  mesh::for_each_graded_triangle(
      grading, [&](const TrianglePoint& p, const TrianglePoint& q, const TrianglePoint& r) {
        const std::array corners{at_point(p), at_point(q), at_point(r)};
        place_edge(row, complex, corners[0], corners[1], places.edges);
        place_edge(row, complex, corners[0], corners[2], places.edges);
        place_edge(row, complex, corners[1], corners[2], places.edges);
        place_triangle(row, complex, corners, places.of_triangles);
      });
}

// Vertices and edges on lines inside of solids stay as those on the geometry do.
void GeometryFinder::place_lines(const mesh::Complex& complex,
                                 const std::vector<mesh::HostPoint>& names,
                                 GeometryPlaces& places) const
{
  places.edge_on_line.assign(at(complex.num_edges()), 0);
  for (const LineEdge& line : lines_) {
    LocalIndex before = kNoIndex;
    for (const mesh::HostPoint& name :
         points_along(skeleton_, hosts_, line.edge, levels_.edge_intervals(line.edge))) {
      const LocalIndex vertex = vertex_named(names, name);
      if (vertex != kNoIndex) places.vertex_on_geometry[at(vertex)] = 1;
      if (vertex != kNoIndex && before != kNoIndex) {
        const auto [low, high] = std::minmax(before, vertex);
        const LocalIndex edge = mesh::find_edge(complex, {low, high});
        if (edge != kNoIndex) places.edge_on_line[at(edge)] = 1;
      }
      before = vertex;
    }
  }
}

GeometryPlaces GeometryFinder::find(const mesh::Complex& complex,
                                    const std::vector<mesh::HostPoint>& names) const
{
  GeometryPlaces places{.triangles = triangles_around(names)};
  for (const mesh::HostPoint& name : names) {
    const bool is_of_skeleton = name.host < hosts_.num_on_skeleton();
    places.vertex_on_geometry.push_back(
        is_of_skeleton && !triangles_of_host_[name.host].empty() ? 1 : 0);
  }
  places.edges.resize(at(complex.num_edges()));
  places.of_triangles.resize(at(complex.num_triangles()));
  for (LocalIndex row = 0; row < static_cast<LocalIndex>(places.triangles.size()); ++row) {
    place_lattice(row, complex, names, places);
  }
  places.num_known = static_cast<LocalIndex>(places.triangles.size());
  place_lines(complex, names, places);
  return places;
}

mesh::RefinedLattice midpoint_lattice(const mesh::Complex& complex,
                                      std::span<const double> vertex_xyz, const KnownPoints& known,
                                      int levels)
{
  return MidpointLattice(complex, known, levels).run(vertex_xyz);
}

mesh::LatticePointKey key_of(const mesh::Skeleton& skeleton, LocalIndex triangle, LocalIndex n,
                             const TrianglePoint& p)
{
  const auto [part, row, k] = lattice::place_of(n, p);
  if (part == lattice::PointPlace::Part::inside) {
    return mesh::LatticePointKey::on_triangle(triangle, n, p);
  }
  return mesh::LatticePointKey::on_edge(skeleton.triangle_edges[3 * at(triangle) + row], n, k);
}

}  // namespace tessera::subdomain
