// SPDX-License-Identifier: BSD-3-Clause
#include "layers/image_columns.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/image_edges.hpp"

namespace tessera::layers {
namespace {

// Vertices at which a wall ends on one side only: an edge of it has an image that is none.
std::vector<bool> ends_of_unlike_edges(const mesh::CoarseMesh& mesh, mesh::ImageKind kind,
                                       const std::set<WallEdge>& on_walls)
{
  std::vector<bool> is_end(at(mesh.num_vertices()), false);
  for (const mesh::ImageEdge& edge : mesh::image_edges(mesh, kind)) {
    if (on_walls.contains(edge.from) == on_walls.contains(edge.to)) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      is_end[at(edge.from[end])] = true;
      is_end[at(edge.to[end])] = true;
    }
  }
  return is_end;
}

// Each member knows only the triangles on its own side, so together they see all around.
Vec3 common_direction(std::span<const LocalIndex> members, const mesh::VertexOrbits& orbits,
                      const WallSurface& walls)
{
  Vec3 sum{};
  for (const LocalIndex v : members) {
    const Vec3 direction = unit(walls.vertices[at(walls.wall_of_vertex[at(v)])].column);
    sum = sum + orbits.images[at(orbits.vertices.image_of(v))].inverse().turned(direction);
  }
  return unit(sum);
}

// The one whose column is shortest.
const WallVertex& shortest(std::span<const LocalIndex> members, const WallSurface& walls)
{
  const auto vertex = [&](LocalIndex v) -> const WallVertex& {
    return walls.vertices[at(walls.wall_of_vertex[at(v)])];
  };
  return vertex(
      *std::ranges::min_element(members, {}, [&](LocalIndex v) { return norm(vertex(v).column); }));
}

// Vertices on a side of a split that has no layers: a column there goes along it, and so must those
// of the vertex's copies.
std::vector<bool> vertices_beside_splits(const mesh::CoarseMesh& mesh, const WallSurface& walls)
{
  std::vector<bool> is_side(at(mesh.num_patches()), false);
  for (LocalIndex minus = 0; minus < mesh.num_patches(); ++minus) {
    if (!mesh.images.is_of_split(minus)) continue;
    is_side[at(minus)] = is_side[at(mesh.images.patch_origin[at(minus)])] = true;
  }
  std::vector<bool> is_beside(at(mesh.num_vertices()), false);
  for (const SurfaceTriangle& triangle : walls.triangles) {
    if (triangle.is_wall || !is_side[at(mesh.face_patch[at(triangle.face)])]) continue;
    for (const LocalIndex v : triangle.vertices) is_beside[at(v)] = true;
  }
  return is_beside;
}

// At how many places there are copies of each vertex.
std::vector<std::size_t> num_places(const mesh::VertexOrbits& orbits, LocalIndex num_vertices)
{
  std::vector<std::set<LocalIndex>> images(at(num_vertices));  // Of the lowest member.
  for (LocalIndex v = 0; v < num_vertices; ++v) {
    images[at(orbits.vertices.base_of(v))].insert(orbits.vertices.image_of(v));
  }
  std::vector<std::size_t> number;
  for (LocalIndex v = 0; v < num_vertices; ++v) {
    number.push_back(images[at(orbits.vertices.base_of(v))].size());
  }
  return number;
}

// Lives for one call of join_image_columns().
class ColumnJoiner {
 public:
  ColumnJoiner(const mesh::CoarseMesh& mesh, const std::set<WallEdge>& on_walls, WallSurface& walls)
      : mesh_(mesh),
        walls_(walls),
        orbits_(mesh::find_vertex_orbits(mesh, mesh::ImageKind::without_joints)),
        periodic_(mesh::find_vertex_orbits(mesh, mesh::ImageKind::periodic).vertices),
        is_end_(ends_of_unlike_edges(mesh, mesh::ImageKind::without_joints, on_walls)),
        is_periodic_end_(ends_of_unlike_edges(mesh, mesh::ImageKind::periodic, on_walls)),
        is_beside_split_(vertices_beside_splits(mesh, walls))
  {
    walls.images = orbits_.images;
  }

  void run()
  {
    hold_sides_of_joints();
    hold_at_unlike_sides();
    const IndexLists members_of = rows_by_key(orbits_.vertices.base, mesh_.num_vertices());
    for (LocalIndex base = 0; base < mesh_.num_vertices(); ++base) {
      const auto members = members_of[base];
      if (std::ranges::any_of(members, [&](LocalIndex v) { return goes_along_split(v); })) {
        join_if_alike(members, is_end_);
      } else {
        join_sides_apart(members);
      }
    }
  }

 private:
  // Where a joint has no layers, it is what those of its other side end at.
  void hold_sides_of_joints()
  {
    for (const SurfaceTriangle& triangle : walls_.triangles) {
      if (triangle.is_wall || !mesh_.images.is_joint(mesh_.face_patch[at(triangle.face)])) continue;
      leave_out(triangle.vertices);
    }
  }

  // Where one side of a joint is periodic and the other is not, their columns would not be computed
  // from the same place.
  void hold_at_unlike_sides()
  {
    const auto own = num_places(orbits_, mesh_.num_vertices());
    const auto all = num_places(mesh::find_vertex_orbits(mesh_), mesh_.num_vertices());
    for (const WallVertex& one : walls_.vertices) {
      if (own[at(one.vertex)] != all[at(one.vertex)]) leave_out(std::array{one.vertex});
    }
  }

  [[nodiscard]] bool is_on_wall(LocalIndex v) const
  {
    return walls_.wall_of_vertex[at(v)] != kNoIndex;
  }
  [[nodiscard]] WallVertex& vertex(LocalIndex v) const
  {
    return walls_.vertices[at(walls_.wall_of_vertex[at(v)])];
  }
  [[nodiscard]] LocalIndex image_of(LocalIndex v) const { return orbits_.vertices.image_of(v); }

  [[nodiscard]] bool goes_along_split(LocalIndex v) const
  {
    return is_on_wall(v) && is_beside_split_[at(v)];
  }

  // Copies at the sides of a split have columns of their own there; each goes with its images.
  void join_sides_apart(std::span<const LocalIndex> members)
  {
    std::map<LocalIndex, std::vector<LocalIndex>> sides;
    for (const LocalIndex v : members) sides[periodic_.base_of(v)].push_back(v);
    for (const auto& [base, side] : sides) join_if_alike(side, is_periodic_end_);
  }

  void join_if_alike(std::span<const LocalIndex> members, const std::vector<bool>& is_end)
  {
    if (members.size() < 2) return;
    if (are_alike(members, is_end)) {
      join(members);
    } else {
      leave_out(members);
    }
  }

  [[nodiscard]] bool are_alike(std::span<const LocalIndex> members,
                               const std::vector<bool>& is_end) const
  {
    const auto image = [&](LocalIndex v) { return image_of(v); };
    if (std::ranges::find(members, 0, image) == members.end()) return false;
    const auto may_join = [&](LocalIndex v) {
      if (!is_on_wall(v) || is_end[at(v)] || vertex(v).column == Vec3{}) return false;
      if (std::ranges::count(members, image_of(v), image) == 1) return true;
      return is_beside_split_[at(v)]
             && go_one_way(v, *std::ranges::find(members, image_of(v), image));
    };
    return std::ranges::all_of(members, may_join) && go_together(members);
  }

  // Where split patches cross, copies may go apart.
  [[nodiscard]] bool go_together(std::span<const LocalIndex> members) const
  {
    const Vec3 common = common_direction(members, orbits_, walls_);
    return std::ranges::all_of(members, [&](LocalIndex v) {
      const Affine& there = orbits_.images[at(image_of(v))];
      return dot(there.turned(common), vertex(v).column) > 0.0;
    });
  }

  // Along the same curve, or patches on the same surface. @pre Both are on walls.
  [[nodiscard]] bool go_one_way(LocalIndex a, LocalIndex b) const
  {
    const auto surface = [&](LocalIndex v) {
      const LocalIndex patch = vertex(v).patch;
      return patch == kNoIndex ? kNoIndex : LocalIndex{mesh_.patch_surface[at(patch)]};
    };
    return is_on_wall(b) && vertex(a).curve == vertex(b).curve && surface(a) == surface(b);
  }

  // The lowest one that is no image leads the others.
  void join(std::span<const LocalIndex> members)
  {
    const LocalIndex base =
        *std::ranges::find(members, 0, [&](LocalIndex v) { return image_of(v); });
    const WallVertex& leader = shortest(members, walls_);
    const Vec3 column = norm(leader.column) * common_direction(members, orbits_, walls_);
    const LocalIndex stack = leader.stack;
    for (const LocalIndex v : members) {
      WallVertex& one = vertex(v);
      one.origin = walls_.wall_of_vertex[at(base)];
      one.image = image_of(v);
      one.column = orbits_.images[at(one.image)].turned(column);
      one.stack = stack;
    }
  }

  void leave_out(std::span<const LocalIndex> members)
  {
    for (const LocalIndex v : members) {
      if (!is_on_wall(v)) continue;
      vertex(v).column = Vec3{};
      vertex(v).stack = 0;
    }
  }

  const mesh::CoarseMesh& mesh_;
  WallSurface& walls_;
  mesh::VertexOrbits orbits_;
  mesh::OrbitTable periodic_;
  std::vector<bool> is_end_;
  std::vector<bool> is_periodic_end_;
  std::vector<bool> is_beside_split_;
};

}  // namespace

void join_image_columns(const mesh::CoarseMesh& mesh, const std::set<WallEdge>& on_walls,
                        WallSurface& walls)
{
  if (!mesh.images.are_none()) ColumnJoiner(mesh, on_walls, walls).run();
}

}  // namespace tessera::layers
