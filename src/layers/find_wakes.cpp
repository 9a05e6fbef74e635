// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/find_wakes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/mesh/face_tets.hpp"
#include "tessera/mesh/image_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "layers/flatten_wakes.hpp"
#include "layers/link_way.hpp"
#include "layers/ridges.hpp"
#include "layers/wall_choice.hpp"
#include "layers/wall_surface.hpp"

namespace tessera::layers {
namespace {

using Edge = std::array<LocalIndex, 2>;

// On each side of a wake the column must be that steep: twice as steep as a single one is at the
// bluntest ridge, and more.
constexpr double kLeastCosine = 0.5;

class WakeFinder {
 public:
  WakeFinder(mesh::CoarseMesh& mesh, std::span<const PatchLayers> patches)
      : mesh_(mesh),
        walls_(find_walls(mesh, patches)),
        ridges_(find_ridges(mesh, walls_)),
        tets_at_(rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4)),
        is_on_surface_(at(mesh.num_vertices()), 0),
        has_obstacle_(at(mesh.num_vertices()), 0)
  {
    for (const LocalIndex v : mesh.face_vertices) is_on_surface_[at(v)] = 1;
    find_obstacles();
    find_partners();
    for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
      is_blocked_.push_back(has_obstacle_[at(v)] != 0 || is_periodic(v)
                            || walls_.wall_of_vertex[at(v)] != kNoIndex);
    }
    for (std::size_t row = 0; row < walls_.triangles.size(); ++row) {
      for (const LocalIndex v : walls_.triangles[row].vertices) {
        triangles_at_[v].push_back(static_cast<LocalIndex>(row));
      }
    }
    for (std::size_t row = 0; row < ridges_.size(); ++row) {
      apexes_.push_back(apex_of(ridges_[row]));
      for (const LocalIndex v : ridges_[row].edge) {
        ridges_at_[v].push_back(static_cast<LocalIndex>(row));
      }
    }
  }

  std::vector<mesh::WakeTriangle> run(bool keep_tets)
  {
    std::vector<RidgeVertex> found;
    for (const auto& [vertex, ridges] : ridges_at_) {
      RidgeVertex one{.vertex = vertex, .ridges = ridges};
      if (!find_way(one)) continue;
      if (is_periodic(vertex)) end_of_way_[vertex] = one.way.back();
      found.push_back(std::move(one));
    }
    drop_without_partner(found);
    if (!keep_tets) flatten_wakes(found, tets_at_, is_on_surface_, mesh_);
    std::erase_if(found, [&](const RidgeVertex& one) { return !has_steep_columns(one); });
    drop_without_partner(found);
    return triangles_of(found);
  }

 private:
  // Of vertices at which the mesh is open, or has another material behind a face; and of those on
  // lines inside.
  void find_obstacles()
  {
    const std::vector<mesh::TriangleTets> tets = mesh::tets_of_faces(mesh_);
    const auto mark = [&](LocalIndex face) {
      for (std::size_t c = 0; c < 3; ++c) {
        has_obstacle_[at(mesh_.face_vertices[3 * at(face) + c])] = 1;
      }
    };
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (tets[at(f)].tets[1] != kNoIndex) mark(f);
      if (mesh_.images.are_none() || mesh_.images.face_origin[at(f)] == kNoIndex) continue;
      if (mesh_.images.patch_transform[at(mesh_.face_patch[at(f)])] != 0) continue;
      mark(f);
      mark(mesh_.images.face_origin[at(f)]);
    }
    for (const LocalIndex v : mesh_.segment_vertices) {
      if (is_on_surface_[at(v)] == 0) has_obstacle_[at(v)] = 1;
    }
  }

  // Where several periodic sides meet is no way, nor on the axis of a rotation.
  void find_partners()
  {
    partner_.assign(at(mesh_.num_vertices()), kNoIndex);
    const auto orbits = mesh::find_vertex_orbits(mesh_, mesh::ImageKind::periodic);
    const IndexLists members_of = rows_by_key(orbits.vertices.base, mesh_.num_vertices());
    for (const mesh::ImageEdge& edge : mesh::image_edges(mesh_, mesh::ImageKind::periodic)) {
      for (std::size_t end = 0; end < 2; ++end) {
        const LocalIndex from = edge.from[end];
        const LocalIndex to = edge.to[end];
        if (members_of[orbits.vertices.base_of(from)].size() == 2) {
          partner_[at(from)] = to;
          partner_[at(to)] = from;
        } else {
          has_obstacle_[at(from)] = has_obstacle_[at(to)] = 1;
        }
      }
    }
  }

  [[nodiscard]] bool is_periodic(LocalIndex vertex) const
  {
    return partner_[at(vertex)] != kNoIndex;
  }

  // Periodic sides are opened alike.
  void drop_without_partner(std::vector<RidgeVertex>& found) const
  {
    std::set<LocalIndex> all;
    for (const RidgeVertex& one : found) all.insert(one.vertex);
    std::erase_if(found, [&](const RidgeVertex& one) {
      return is_periodic(one.vertex) && !all.contains(partner_[at(one.vertex)]);
    });
  }

  [[nodiscard]] const SurfaceTriangle& triangle(LocalIndex row) const
  {
    return walls_.triangles[at(row)];
  }

  // Of the vertices off the walls that have a triangle on the edge, the one nearest to the middle.
  [[nodiscard]] LocalIndex apex_of(const Ridge& ridge) const
  {
    const Edge& edge = ridge.edge;
    const Vec3 along = unit(mesh_.position(edge[1]) - mesh_.position(edge[0]));
    LocalIndex nearest = kNoIndex;
    double least = std::numeric_limits<double>::infinity();
    for (const LocalIndex tet : tets_at_[edge[0]]) {
      const auto corners = mesh_.tet(tet);
      if (std::ranges::count(corners, edge[1]) == 0) continue;
      for (const LocalIndex v : corners) {
        if (is_blocked_[at(v)] != 0) continue;
        const Vec3 there = mesh_.position(v) - mesh_.position(edge[0]);
        const double angle = angle_between(there - dot(there, along) * along, ridge.middle);
        if (angle < least || (angle == least && v < nearest)) {
          least = angle;
          nearest = v;
        }
      }
    }
    return nearest;
  }

  [[nodiscard]] LocalIndex other_end(LocalIndex ridge, LocalIndex vertex) const
  {
    const Edge& edge = ridges_[at(ridge)].edge;
    return edge[0] == vertex ? edge[1] : edge[0];
  }

  // Patches without layers at a vertex.
  [[nodiscard]] std::vector<LocalIndex> sides_at(LocalIndex vertex) const
  {
    std::vector<LocalIndex> patches;
    for (const LocalIndex row : triangles_at_.at(vertex)) {
      if (!triangle(row).is_wall) patches.push_back(mesh_.face_patch[at(triangle(row).face)]);
    }
    sort_unique(patches);
    return patches;
  }

  // Vertices beside `vertex` where a wake may end: on the patch without layers, off the walls. On a
  // periodic side it is where that of the partner ends.
  [[nodiscard]] std::set<LocalIndex> ends_on_side(LocalIndex vertex) const
  {
    const auto of_partner = end_of_way_.find(partner_[at(vertex)]);
    std::set<LocalIndex> ends;
    for (const LocalIndex row : triangles_at_.at(vertex)) {
      if (triangle(row).is_wall) continue;
      for (const LocalIndex v : triangle(row).vertices) {
        const bool is_free = has_obstacle_[at(v)] == 0 && walls_.wall_of_vertex[at(v)] == kNoIndex
                             && is_periodic(v) == is_periodic(vertex);
        if (!is_free) continue;
        if (of_partner == end_of_way_.end() || of_partner->second == partner_[at(v)])
          ends.insert(v);
      }
    }
    return ends;
  }

  // From the one ridge through the material to the other one, or to the patch without layers.
  bool find_way(RidgeVertex& one) const
  {
    const std::size_t num_sides = sides_at(one.vertex).size();
    if (has_obstacle_[at(one.vertex)] != 0 || one.ridges.size() + num_sides != 2) return false;
    if (one.ridges.empty()) return false;
    for (const LocalIndex ridge : one.ridges) {
      if (apexes_[at(ridge)] == kNoIndex) return false;
    }
    one.normal = normal_at(one);
    const LocalIndex first = apexes_[at(one.ridges.front())];
    const std::set<LocalIndex> ends = num_sides > 0
                                          ? ends_on_side(one.vertex)
                                          : std::set<LocalIndex>{apexes_[at(one.ridges.back())]};
    const LinkOf link(mesh_, tets_at_[one.vertex], one.vertex);
    one.way = link.way(first, ends, is_blocked_, one.normal);
    if (one.way.empty()) return false;
    one.way.insert(one.way.begin(), other_end(one.ridges.front(), one.vertex));
    if (num_sides == 0) one.way.push_back(other_end(one.ridges.back(), one.vertex));
    return true;
  }

  // Of the plane in the middle between the walls.
  [[nodiscard]] Vec3 normal_at(const RidgeVertex& one) const
  {
    Vec3 middle{};
    for (const LocalIndex ridge : one.ridges) middle = middle + ridges_[at(ridge)].middle;
    const Vec3 from = mesh_.position(other_end(one.ridges.front(), one.vertex));
    const Vec3 to = one.ridges.size() > 1 ? mesh_.position(other_end(one.ridges.back(), one.vertex))
                                          : mesh_.position(one.vertex);
    return unit(cross(to - from, middle));
  }

  [[nodiscard]] static bool is_in_wake(const RidgeVertex& one, LocalIndex a, LocalIndex b)
  {
    for (std::size_t i = 1; i < one.way.size(); ++i) {
      if (mesh::sorted_edge(a, b) == mesh::sorted_edge(one.way[i - 1], one.way[i])) return true;
    }
    return false;
  }

  // Which tets around the vertex hang together: of each of tets_at_ the first one.
  [[nodiscard]] std::vector<LocalIndex> parts_of(const RidgeVertex& one) const
  {
    const auto tets = tets_at_[one.vertex];
    UnionFind parts(static_cast<LocalIndex>(tets.size()));
    std::map<Edge, LocalIndex> first;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      for (const Edge& edge : link_edges(tets[i], one.vertex)) {
        if (is_in_wake(one, edge[0], edge[1])) continue;
        const auto [found, is_new] = first.try_emplace(edge, static_cast<LocalIndex>(i));
        if (!is_new) parts.join(found->second, static_cast<LocalIndex>(i));
      }
    }
    std::vector<LocalIndex> part_of;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      part_of.push_back(parts.find(static_cast<LocalIndex>(i)));
    }
    return part_of;
  }

  [[nodiscard]] std::array<Edge, 3> link_edges(LocalIndex tet, LocalIndex vertex) const
  {
    std::array<Edge, 3> edges{};
    std::size_t row = 0;
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      const Edge edge = mesh::sorted_edge(mesh_.tet(tet)[a], mesh_.tet(tet)[b]);
      if (std::ranges::count(edge, vertex) == 0) edges[row++] = edge;
    }
    return edges;
  }

  // Whether the tets around a vertex are parted in two, with a steep column on either side.
  [[nodiscard]] bool has_steep_columns(const RidgeVertex& one) const
  {
    const std::vector<LocalIndex> part_of = parts_of(one);
    std::vector<LocalIndex> parts = part_of;
    sort_unique(parts);
    if (parts.size() != 2) return false;
    const auto least_of = [&](LocalIndex part) {
      std::vector<Vec3> normals;
      for (std::size_t i = 0; i < part_of.size(); ++i) {
        if (part_of[i] == part) add_normals(one, tets_at_[one.vertex][i], normals);
      }
      return least_cosine(normals, normal_of_side(one.vertex));
    };
    return std::min(least_of(parts[0]), least_of(parts[1])) > kLeastCosine;
  }

  // Of the sides of a tet on walls and on the wake.
  void add_normals(const RidgeVertex& one, LocalIndex tet, std::vector<Vec3>& normals) const
  {
    for (const Edge& edge : link_edges(tet, one.vertex)) {
      if (!is_in_wake(one, edge[0], edge[1]) && !is_wall(one.vertex, edge)) continue;
      normals.push_back(inward_normal(one.vertex, edge, tet));
    }
  }

  [[nodiscard]] bool is_wall(LocalIndex vertex, const Edge& edge) const
  {
    const auto& rows = triangles_at_.at(vertex);
    return std::ranges::any_of(rows, [&](LocalIndex row) {
      const auto& v = triangle(row).vertices;
      return triangle(row).is_wall && std::ranges::count(v, edge[0]) > 0
             && std::ranges::count(v, edge[1]) > 0;
    });
  }

  // Of a side of a tet, towards the tet.
  [[nodiscard]] Vec3 inward_normal(LocalIndex vertex, const Edge& edge, LocalIndex tet) const
  {
    const Vec3 here = mesh_.position(vertex);
    const Vec3 normal = unit(cross(mesh_.position(edge[0]) - here, mesh_.position(edge[1]) - here));
    const LocalIndex top = *std::ranges::find_if(
        mesh_.tet(tet), [&](LocalIndex v) { return v != vertex && v != edge[0] && v != edge[1]; });
    return dot(normal, mesh_.position(top) - here) > 0.0 ? normal : -1.0 * normal;
  }

  // Of the patch without layers at a vertex; zero if there is none.
  [[nodiscard]] Vec3 normal_of_side(LocalIndex vertex) const
  {
    Vec3 normal{};
    for (const LocalIndex row : triangles_at_.at(vertex)) {
      if (!triangle(row).is_wall) normal = normal + triangle(row).normal;
    }
    return unit(normal);
  }

  // Between the best column and the normals, along a patch with the normal `across`.
  [[nodiscard]] static double least_cosine(std::span<const Vec3> normals, const Vec3& across)
  {
    std::vector<Vec3> along;
    for (const Vec3& normal : normals) {
      along.push_back(unit(normal - dot(normal, across) * across));
    }
    const Vec3 direction = best_direction(along);
    double least = 1.0;
    for (const Vec3& normal : along) least = std::min(least, dot(normal, direction));
    return least;
  }

  [[nodiscard]] std::vector<mesh::WakeTriangle> triangles_of(
      const std::vector<RidgeVertex>& opened) const
  {
    std::map<std::array<LocalIndex, 3>, LocalIndex> wall_of;
    for (const RidgeVertex& one : opened) {
      const LocalIndex wall = lowest_wall(one.vertex);
      for (std::size_t i = 1; i < one.way.size(); ++i) {
        const auto key = mesh::sorted_triangle(one.vertex, one.way[i - 1], one.way[i]);
        const auto [found, is_new] = wall_of.emplace(key, wall);
        if (!is_new) found->second = std::min(found->second, wall);
      }
    }
    std::vector<mesh::WakeTriangle> triangles;
    for (const auto& [vertices, wall] : wall_of) triangles.push_back({vertices, wall});
    return triangles;
  }

  [[nodiscard]] LocalIndex lowest_wall(LocalIndex vertex) const
  {
    LocalIndex lowest = mesh_.num_patches();
    for (const LocalIndex row : triangles_at_.at(vertex)) {
      if (triangle(row).is_wall)
        lowest = std::min(lowest, LocalIndex{mesh_.face_patch[at(triangle(row).face)]});
    }
    return lowest;
  }

  mesh::CoarseMesh& mesh_;
  WallSurface walls_;
  std::vector<Ridge> ridges_;
  std::vector<LocalIndex> apexes_{};   // Of the triangles of the wakes on them; or kNoIndex.
  IndexLists tets_at_;                 // Of each vertex.
  std::vector<char> is_on_surface_;    // Of each vertex: on a face.
  std::vector<char> has_obstacle_;     // Of each vertex.
  std::vector<LocalIndex> partner_{};  // Of each vertex on a periodic side its image.
  std::map<LocalIndex, LocalIndex> end_of_way_{};  // Of vertices there.
  std::vector<char> is_blocked_{};                 // Of each vertex: no wake may end there.
  std::map<LocalIndex, std::vector<LocalIndex>> triangles_at_{};  // Rows of walls_, by vertex.
  std::map<LocalIndex, std::vector<LocalIndex>> ridges_at_{};     // By vertex.
};

}  // namespace

std::vector<mesh::WakeTriangle> find_wakes(mesh::CoarseMesh& mesh,
                                           std::span<const LayerOptions> options, bool keep_tets)
{
  std::vector<PatchLayers> patches;
  for (const LocalIndex entry : entries_of_patches(mesh, options)) {
    patches.push_back({.thickness = entry == kNoIndex ? 0.0 : thickness(options[at(entry)])});
  }
  const WallSurface walls = find_walls(mesh, patches);
  if (find_ridges(mesh, walls).empty()) return {};
  if (!keep_tets) divide_at_ridges(walls, mesh);
  return WakeFinder(mesh, patches).run(keep_tets);
}

}  // namespace tessera::layers
