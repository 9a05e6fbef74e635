// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece_surface.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>

#include "check/match_vertices.hpp"
#include "check/union_find.hpp"

namespace tessera::check {
namespace {

// Gives the points of a piece that are kept new consecutive numbers.
class VertexSelection {
 public:
  VertexSelection(const PieceMesh& mesh, PieceSurface& surface)
      : mesh_(mesh), surface_(surface), row_(static_cast<std::size_t>(mesh.num_points()), kNoIndex)
  {
  }

  LocalIndex add(LocalIndex point, bool is_used, bool is_inner)
  {
    LocalIndex& row = row_[static_cast<std::size_t>(point)];
    if (row != kNoIndex) return row;
    row = static_cast<LocalIndex>(surface_.vertices.size());
    VertexRecord record;
    record.position = mesh_.position(point);
    record.id = mesh_.point_id(point);
    record.piece = mesh_.name.piece;
    record.point = point;
    record.is_used = is_used;
    record.is_inner = is_inner;
    record.is_listed = mesh_.name.is_boundary;
    surface_.vertices.push_back(record);
    return row;
  }

 private:
  const PieceMesh& mesh_;
  PieceSurface& surface_;
  std::vector<LocalIndex> row_;
};

PieceSurface empty_surface(const PieceMesh& mesh)
{
  PieceSurface surface;
  surface.name = mesh.name;
  surface.identity = mesh.identity;
  return surface;
}

// Key, parity and centroid of the last triangle of the surface.
TriangleRecord record_of_last(const PieceSurface& surface)
{
  const auto& vertices = surface.triangles.back();
  TriangleRecord record;
  for (std::size_t i = 0; i < 3; ++i) record.key[i] = surface.key(vertices[i]);
  record.is_odd = is_odd(record.key[0], record.key[1], record.key[2]);
  std::sort(record.key.begin(), record.key.end());
  const Vec3 sum =
      surface.position(vertices[0]) + surface.position(vertices[1]) + surface.position(vertices[2]);
  for (std::size_t i = 0; i < 3; ++i) record.centroid[i] = static_cast<float>(sum[i] / 3.0);
  record.piece = surface.name.piece;
  record.cell = surface.cells.back();
  record.is_listed = surface.name.is_boundary;
  return record;
}

// One corner of a surface triangle seen as the edge that starts there.
struct TriangleEdge {
  LocalIndex lower = 0;
  LocalIndex upper = 0;
  LocalIndex triangle = 0;
  LocalIndex apex = 0;

  friend auto operator<=>(const TriangleEdge&, const TriangleEdge&) = default;
};

std::vector<TriangleEdge> sorted_edges(const PieceSurface& surface)
{
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [lower, upper] = std::minmax(v[i], v[(i + 1) % 3]);
      edges.push_back({lower, upper, static_cast<LocalIndex>(t), v[(i + 2) % 3]});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Calls back with the triangles at each edge.
template <class Visit>
void for_each_edge(std::span<const TriangleEdge> edges, const Visit& visit)
{
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].lower == edges[begin].lower
           && edges[end].upper == edges[begin].upper)
      ++end;
    visit(edges.subspan(begin, end - begin));
  }
}

// Unit vector from the edge to the apex, normal to the edge; zero if they are on one line.
Vec3 inward_of(const PieceSurface& surface, const TriangleEdge& edge)
{
  const Vec3 along = surface.position(edge.upper) - surface.position(edge.lower);
  const Vec3 to_apex = surface.position(edge.apex) - surface.position(edge.lower);
  const Vec3 across = to_apex - (dot(to_apex, along) / dot(along, along)) * along;
  const double length = norm(across);
  return length > 0.0 ? (1.0 / length) * across : Vec3{};
}

EdgeRecord record_of(const PieceSurface& surface, const TriangleEdge& edge)
{
  EdgeRecord record;
  record.key = {surface.key(edge.lower), surface.key(edge.upper)};
  std::sort(record.key.begin(), record.key.end());
  const Vec3 middle = midpoint(surface.position(edge.lower), surface.position(edge.upper));
  for (std::size_t i = 0; i < 3; ++i) record.middle[i] = static_cast<float>(middle[i]);
  record.piece = surface.name.piece;
  record.cell = surface.cells[static_cast<std::size_t>(edge.triangle)];
  return record;
}

// Number of the set of boundary triangles each boundary triangle is in; other triangles: -1.
std::vector<LocalIndex> boundary_components(const PieceSurface& surface,
                                            std::span<const TriangleEdge> edges,
                                            LocalIndex& num_components)
{
  const auto is_outside = [&](LocalIndex t) {
    return is_open(surface.roles[static_cast<std::size_t>(t)]);
  };
  const auto num_triangles = static_cast<LocalIndex>(surface.triangles.size());
  UnionFind sets(num_triangles);
  for_each_edge(edges, [&](std::span<const TriangleEdge> triangles) {
    LocalIndex first = kNoIndex;
    for (const TriangleEdge& edge : triangles) {
      if (!is_outside(edge.triangle)) continue;
      if (first == kNoIndex) first = edge.triangle;
      sets.join(first, edge.triangle);
    }
  });
  std::vector<LocalIndex> component(surface.triangles.size(), kNoIndex);
  num_components = 0;
  for (LocalIndex t = 0; t < num_triangles; ++t) {
    if (!is_outside(t)) continue;
    const LocalIndex root = sets.find(t);  // The lowest of its set, so it has its number by now.
    component[static_cast<std::size_t>(t)] =
        root == t ? num_components++ : component[static_cast<std::size_t>(root)];
  }
  return component;
}

}  // namespace

VertexKey PieceSurface::key(LocalIndex v) const
{
  return key_of(vertices[static_cast<std::size_t>(v)], identity);
}

PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology,
                          std::vector<TriangleRecord>& records)
{
  PieceSurface surface = empty_surface(mesh);
  VertexSelection selection(mesh, surface);
  for (const SurfaceTriangle& triangle : topology.surface) {
    const auto& v = triangle.vertices;
    surface.triangles.push_back({selection.add(v[0], true, false), selection.add(v[1], true, false),
                                 selection.add(v[2], true, false)});
    surface.cells.push_back(triangle.cell);
    surface.subdomains.push_back(mesh.subdomain_of(triangle.cell));
    TriangleRecord record = record_of_last(surface);
    record.component = triangle.component;
    record.attribute = mesh.material(triangle.cell);
    record.subdomain = mesh.subdomain_of(triangle.cell);
    record.cell_id = mesh.cell_id(triangle.cell);
    records.push_back(record);
  }
  if (mesh.identity == Identity::kIds) {
    for (const LocalIndex p : mesh.unused_points) selection.add(p, false, false);
  } else {
    for (const LocalIndex v : mesh.cell_vertices)
      if (v != kNoIndex) selection.add(v, true, true);
  }
  return surface;
}

PieceSurface make_boundary_surface(const PieceMesh& mesh, std::vector<TriangleRecord>& records)
{
  PieceSurface surface = empty_surface(mesh);
  VertexSelection selection(mesh, surface);
  const auto tet = mesh.arrays.cell_longs.find("tet");
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    const auto v = mesh.cell(c);
    surface.triangles.push_back({selection.add(v[0], false, false),
                                 selection.add(v[1], false, false),
                                 selection.add(v[2], false, false)});
    surface.cells.push_back(c);
    TriangleRecord record = record_of_last(surface);
    record.subdomain = mesh.subdomain_of(c);
    if (tet != mesh.arrays.cell_longs.end())
      record.cell_id = tet->second[static_cast<std::size_t>(c)];
    records.push_back(record);
  }
  return surface;
}

void mark_seam_vertices(PieceSurface& surface)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const bool is_seam =
        surface.roles[t] == TriangleRole::kSeam || surface.roles[t] == TriangleRole::kOpenSeam;
    if (!is_seam) continue;
    for (const LocalIndex v : surface.triangles[t])
      surface.vertices[static_cast<std::size_t>(v)].is_on_seam = true;
  }
}

void add_outside_areas(const PieceSurface& surface, PieceRecords& records)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.roles[t] != TriangleRole::kOutside) continue;
    const auto& v = surface.triangles[t];
    const Vec3& origin = surface.position(v[0]);
    const double area =
        0.5 * norm(cross(surface.position(v[1]) - origin, surface.position(v[2]) - origin));
    if (std::isfinite(area)) records.of(surface.subdomains[t]).boundary_area += area;
  }
}

SurfaceEdges append_edges(const PieceSurface& surface, std::vector<EdgeRecord>& records)
{
  const std::vector<TriangleEdge> edges = sorted_edges(surface);
  SurfaceEdges counts;
  const auto component = boundary_components(surface, edges, counts.num_boundary_components);
  for_each_edge(edges, [&](std::span<const TriangleEdge> triangles) {
    ++counts.num_edges;
    const std::size_t num_before = records.size();
    for (const TriangleEdge& edge : triangles) {
      const LocalIndex set = component[static_cast<std::size_t>(edge.triangle)];
      if (set == kNoIndex) continue;
      EdgeRecord& record = records.emplace_back(record_of(surface, edge));
      record.inward = inward_of(surface, edge);
      record.boundary_component = set;
      record.is_on_boundary = true;
    }
    if (records.size() == num_before) records.push_back(record_of(surface, triangles[0]));
  });
  return counts;
}

}  // namespace tessera::check
