// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/skeleton.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/mesh/triangle_grading.hpp"

#include "mesh/skeleton_orbits.hpp"

namespace tessera::mesh {
namespace {

using Edge = std::array<LocalIndex, 2>;
using Triangle = std::array<LocalIndex, 3>;

// Faces of the coarse mesh by their sorted vertices, for look-up by binary search.
struct FaceTable {
  struct Row {
    Triangle vertices;
    LocalIndex face;
  };
  std::vector<Row> rows;

  explicit FaceTable(const CoarseMesh& coarse)
  {
    for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
      const auto* v = &coarse.face_vertices[3 * at(f)];
      rows.push_back({sorted_triangle(v[0], v[1], v[2]), f});
    }
    std::sort(rows.begin(), rows.end(),
              [](const Row& a, const Row& b) { return a.vertices < b.vertices; });
  }

  [[nodiscard]] LocalIndex find(const Triangle& vertices) const
  {
    const auto row =
        std::lower_bound(rows.begin(), rows.end(), vertices,
                         [](const Row& a, const Triangle& wanted) { return a.vertices < wanted; });
    return row != rows.end() && row->vertices == vertices ? row->face : kNoIndex;
  }
};

// Corner parameters of a face, put into the order of the sorted vertices.
void append_face_uv(const CoarseMesh& coarse, LocalIndex face, const Triangle& sorted,
                    FlatArray<double>& uv)
{
  for (const LocalIndex v : sorted) {
    std::size_t corner = 0;
    if (face != kNoIndex) {
      while (coarse.face_vertices[3 * at(face) + corner] != v) ++corner;
    }
    const bool known = face != kNoIndex && !coarse.face_uv.empty();
    for (std::size_t d = 0; d < 2; ++d) {
      uv.push_back(known ? coarse.face_uv[2 * (3 * at(face) + corner) + d] : 0.0);
    }
  }
}

// Whether the sorted orientation of a triangle points out of the tet that it is a face of.
bool sorted_points_out_of(const CoarseMesh& coarse, LocalIndex tet, LocalIndex opposite_corner)
{
  const auto vertices = coarse.tet(tet);
  const auto& face = kTetFaceCorners[at(opposite_corner)];
  return is_even_triangle(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
}

// Triangles still in coarse vertex numbers. @return The coarse face of each, or kNoIndex.
std::vector<LocalIndex> collect_triangles(const CoarseMesh& coarse,
                                          const Decomposition& decomposition, Skeleton& out)
{
  std::vector<LocalIndex> triangle_face;
  const FaceTable faces(coarse);
  for (const TriangleTets& triangle : triangles_of_tets(coarse.tet_vertices)) {
    std::array<LocalIndex, 2> subdomains{kNoIndex, kNoIndex};
    for (std::size_t side = 0; side < 2; ++side) {
      if (triangle.tets[side] == kNoIndex) continue;
      const bool out_of = sorted_points_out_of(coarse, triangle.tets[side], triangle.corners[side]);
      subdomains[out_of ? 0 : 1] = decomposition.tet_subdomain[at(triangle.tets[side])];
    }
    if (subdomains[0] == subdomains[1]) continue;
    const LocalIndex face = faces.find(triangle.vertices);
    triangle_face.push_back(face);
    out.triangle_vertices.insert(out.triangle_vertices.end(), triangle.vertices.begin(),
                                 triangle.vertices.end());
    out.triangle_patch.push_back(face == kNoIndex ? kNoIndex : coarse.face_patch[at(face)]);
    append_face_uv(coarse, face, triangle.vertices, out.triangle_uv);
    out.triangle_subdomains.insert(out.triangle_subdomains.end(), subdomains.begin(),
                                   subdomains.end());
  }
  return triangle_face;
}

LocalIndex skeleton_vertex(const Skeleton& skeleton, LocalIndex coarse_vertex)
{
  const auto& vertices = skeleton.vertex_coarse;
  const auto place = std::lower_bound(vertices.begin(), vertices.end(), coarse_vertex);
  return place != vertices.end() && *place == coarse_vertex
             ? static_cast<LocalIndex>(place - vertices.begin())
             : kNoIndex;
}

// Renumbers the triangles' vertices from coarse to skeleton numbers; the order is kept.
void number_vertices(Skeleton& out)
{
  out.vertex_coarse = out.triangle_vertices;
  std::sort(out.vertex_coarse.begin(), out.vertex_coarse.end());
  out.vertex_coarse.erase(std::unique(out.vertex_coarse.begin(), out.vertex_coarse.end()),
                          out.vertex_coarse.end());
  for (LocalIndex& v : out.triangle_vertices) v = skeleton_vertex(out, v);
}

LocalIndex find_edge(const std::vector<Edge>& edges, const Edge& edge)
{
  const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
  return place != edges.end() && *place == edge ? static_cast<LocalIndex>(place - edges.begin())
                                                : kNoIndex;
}

std::array<Edge, 3> sides_of(const Skeleton& skeleton, LocalIndex t)
{
  const auto* v = &skeleton.triangle_vertices[3 * at(t)];
  return {Edge{v[0], v[1]}, Edge{v[0], v[2]}, Edge{v[1], v[2]}};
}

std::vector<Edge> number_edges(Skeleton& out)
{
  std::vector<Edge> edges;
  for (LocalIndex t = 0; t < out.num_triangles(); ++t) {
    for (const Edge& edge : sides_of(out, t)) edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const Edge& edge : edges) {
    out.edge_vertices.insert(out.edge_vertices.end(), edge.begin(), edge.end());
  }
  for (LocalIndex t = 0; t < out.num_triangles(); ++t) {
    for (const Edge& edge : sides_of(out, t)) out.triangle_edges.push_back(find_edge(edges, edge));
  }
  return edges;
}

// The owner of an entity is the lowest subdomain of the triangles around it. No other subdomain can
// hold it, because the closures of two subdomains meet only in skeleton triangles.
void set_owners(Skeleton& out)
{
  const LocalIndex nobody = std::numeric_limits<LocalIndex>::max();
  out.vertex_owner.assign(out.vertex_coarse.size(), nobody);
  out.edge_owner.assign(out.edge_vertices.size() / 2, nobody);
  for (LocalIndex t = 0; t < out.num_triangles(); ++t) {
    const LocalIndex owner = out.triangle_owner(t);
    for (std::size_t c = 0; c < 3; ++c) {
      LocalIndex& of_vertex = out.vertex_owner[at(out.triangle_vertices[3 * at(t) + c])];
      LocalIndex& of_edge = out.edge_owner[at(out.triangle_edges[3 * at(t) + c])];
      of_vertex = std::min(of_vertex, owner);
      of_edge = std::min(of_edge, owner);
    }
  }
}

// The lowest of some triangles on the geometry gives an edge its patch and the parameters of its
// ends. What is there already stays.
template <class IsOne>
void set_edge_patches(const Skeleton& skeleton, const IsOne& is_one, FlatArray<LocalIndex>& patch,
                      FlatArray<double>& parameters)
{
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    if (skeleton.triangle_patch[at(t)] == kNoIndex || !is_one(t)) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      const std::size_t edge = at(skeleton.triangle_edges[3 * at(t) + side]);
      if (patch[edge] != kNoIndex) continue;
      patch[edge] = skeleton.triangle_patch[at(t)];
      for (std::size_t end = 0; end < 2; ++end) {
        const double* uv = &skeleton.triangle_uv[2 * (3 * at(t) + kSideEnds[side][end])];
        std::copy_n(uv, 2, &parameters[2 * (2 * edge + end)]);
      }
    }
  }
}

// Curves that leave a wall come before patches beside it, as where layers grow.
void set_vertex_sides(Skeleton& out)
{
  out.vertex_side_edge.assign(at(out.num_vertices()), kNoIndex);
  for (const bool is_curve : {true, false}) {
    for (LocalIndex e = 0; e < out.num_edges(); ++e) {
      const bool counts = is_curve ? !out.is_on_wall(e) && out.edge_curve[at(e)] != kNoIndex
                                   : out.edge_side_patch[at(e)] != kNoIndex;
      if (!counts) continue;
      for (std::size_t end = 0; end < 2; ++end) {
        LocalIndex& edge = out.vertex_side_edge[at(out.edge_vertices[2 * at(e) + end])];
        if (edge == kNoIndex) edge = e;
      }
    }
  }
}

// Which edges lie on walls, and what else they lie on there.
void set_edge_walls(const WallLayers& layers, Skeleton& out)
{
  if (layers.are_none()) return;
  const auto is_wall = [&](LocalIndex t) { return layers.is_wall(out.triangle_patch[at(t)]); };
  const auto num_edges = at(out.num_edges());
  out.edge_on_wall.assign(num_edges, 0);
  for (LocalIndex t = 0; t < out.num_triangles(); ++t) {
    if (!is_wall(t)) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      out.edge_on_wall[at(out.triangle_edges[3 * at(t) + side])] = 1;
    }
  }
  out.edge_side_patch.assign(num_edges, kNoIndex);
  out.edge_side_uv.assign(4 * num_edges, 0.0);
  set_edge_patches(
      out, [&](LocalIndex t) { return !is_wall(t); }, out.edge_side_patch, out.edge_side_uv);
  for (std::size_t e = 0; e < num_edges; ++e) {
    if (out.edge_on_wall[e] == 0) out.edge_side_patch[e] = kNoIndex;
  }
  set_vertex_sides(out);
}

// A segment puts its edge on a curve; of duplicate segments the lowest counts.
void set_edge_curves(const CoarseMesh& coarse, const std::vector<Edge>& edges, Skeleton& out)
{
  for (LocalIndex s = 0; s < coarse.num_segments(); ++s) {
    const LocalIndex a = skeleton_vertex(out, coarse.segment_vertices[2 * at(s)]);
    const LocalIndex b = skeleton_vertex(out, coarse.segment_vertices[2 * at(s) + 1]);
    const LocalIndex edge = find_edge(edges, {std::min(a, b), std::max(a, b)});
    if (edge == kNoIndex || out.edge_curve[at(edge)] != kNoIndex) continue;
    out.edge_curve[at(edge)] = coarse.segment_curve[at(s)];
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t from = a < b ? end : 1 - end;
      double* parameters = &out.edge_parameters[2 * (2 * at(edge) + end)];
      parameters[0] = coarse.segment_t.empty() ? 0.0 : coarse.segment_t[2 * at(s) + from];
      parameters[1] = 0.0;
    }
  }
}

// Canonical records: curves come before patches, and walls before patches without layers. Wakes lie
// on no geometry, so they give none.
void set_edge_records(const CoarseMesh& coarse, const std::vector<Edge>& edges, Skeleton& out)
{
  out.edge_curve.assign(edges.size(), kNoIndex);
  out.edge_patch.assign(edges.size(), kNoIndex);
  out.edge_parameters.assign(4 * edges.size(), 0.0);
  const auto is_any = [&](LocalIndex t) { return !coarse.is_wake(out.triangle_patch[at(t)]); };
  const auto is_wall = [&](LocalIndex t) {
    return coarse.layers.is_wall(out.triangle_patch[at(t)]) && is_any(t);
  };
  set_edge_patches(out, is_wall, out.edge_patch, out.edge_parameters);
  set_edge_patches(out, is_any, out.edge_patch, out.edge_parameters);
  set_edge_curves(coarse, edges, out);
  set_edge_walls(coarse.layers, out);
}

// Edges at one place on the two sides of a wake may have other triangles beside them, and are still
// refined alike.
void share_records_of_wakes(const CoarseMesh& coarse, Skeleton& out)
{
  for (LocalIndex t = 0; t < out.num_triangles(); ++t) {
    if (!coarse.is_wake(out.triangle_patch[at(t)])) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      const LocalIndex edge = out.triangle_edges[3 * at(t) + side];
      const LocalIndex base = out.orbits.edges.base_of(edge);
      if (base == edge) continue;
      out.edge_curve[at(edge)] = LocalIndex{out.edge_curve[at(base)]};
      out.edge_patch[at(edge)] = LocalIndex{out.edge_patch[at(base)]};
      std::copy_n(&out.edge_parameters[4 * at(base)], 4, &out.edge_parameters[4 * at(edge)]);
    }
  }
}

}  // namespace

LocalIndex Skeleton::triangle_owner(LocalIndex t) const
{
  const LocalIndex a = triangle_subdomains[2 * at(t)];
  const LocalIndex b = triangle_subdomains[2 * at(t) + 1];
  if (a == kNoIndex) return b;
  return b == kNoIndex ? a : std::min(a, b);
}

bool Skeleton::is_inside(LocalIndex t) const
{
  return triangle_subdomains[2 * at(t)] != kNoIndex
         && triangle_subdomains[2 * at(t) + 1] != kNoIndex;
}

Skeleton build_skeleton(const CoarseMesh& coarse, const Decomposition& decomposition)
{
  Skeleton skeleton;
  const std::vector<LocalIndex> triangle_face = collect_triangles(coarse, decomposition, skeleton);
  number_vertices(skeleton);
  const std::vector<Edge> edges = number_edges(skeleton);
  set_owners(skeleton);
  set_edge_records(coarse, edges, skeleton);
  skeleton.subdomain_triangles =
      rows_by_key(skeleton.triangle_subdomains, decomposition.num_subdomains(), 2);
  skeleton.orbits = find_orbits(skeleton, coarse, triangle_face);
  share_records_of_wakes(coarse, skeleton);
  return skeleton;
}

std::vector<char> hosts_on_seams(const Skeleton& skeleton, const Decomposition& decomposition)
{
  const HostLayout hosts(skeleton);
  std::vector<char> on_seam(at(hosts.num_on_skeleton()), 0);
  const auto material = [&](LocalIndex t, std::size_t side) {
    const LocalIndex subdomain = skeleton.triangle_subdomains[2 * at(t) + side];
    return decomposition.subdomain_material[at(subdomain)];
  };
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    if (!skeleton.is_inside(t) || material(t, 0) != material(t, 1)) continue;
    on_seam[at(hosts.triangle(t))] = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      on_seam[at(hosts.vertex(skeleton.triangle_vertices[3 * at(t) + c]))] = 1;
      on_seam[at(hosts.edge(skeleton.triangle_edges[3 * at(t) + c]))] = 1;
    }
  }
  return on_seam;
}

std::vector<std::vector<LocalIndex>> neighbours_by_vertex(const Skeleton& skeleton)
{
  std::vector<std::vector<LocalIndex>> around(at(skeleton.num_vertices()));
  for (LocalIndex subdomain = 0; subdomain < skeleton.num_subdomains(); ++subdomain) {
    for (const LocalIndex t : skeleton.triangles_of(subdomain)) {
      for (std::size_t c = 0; c < 3; ++c) {
        auto& there = around[at(skeleton.triangle_vertices[3 * at(t) + c])];
        if (there.empty() || there.back() != subdomain) there.push_back(subdomain);
      }
    }
  }
  std::vector<std::vector<LocalIndex>> neighbours(at(skeleton.num_subdomains()));
  for (const auto& there : around) {
    for (const LocalIndex s : there) {
      std::ranges::copy_if(there, std::back_inserter(neighbours[at(s)]),
                           [&](LocalIndex other) { return other != s; });
    }
  }
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

}  // namespace tessera::mesh
