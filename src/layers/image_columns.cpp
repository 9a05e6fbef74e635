// SPDX-License-Identifier: BSD-3-Clause
#include "layers/image_columns.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/image_edges.hpp"

namespace tessera::layers {
namespace {

// Vertices at which a wall ends on one side only: an edge of it has an image that is none.
std::vector<bool> ends_of_unlike_edges(const mesh::CoarseMesh& mesh,
                                       const std::set<WallEdge>& on_walls)
{
  std::vector<bool> is_end(at(mesh.num_vertices()), false);
  for (const mesh::ImageEdge& edge : mesh::image_edges(mesh)) {
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

}  // namespace

void join_image_columns(const mesh::CoarseMesh& mesh, const std::set<WallEdge>& on_walls,
                        WallSurface& walls)
{
  if (mesh.images.are_none()) return;
  const mesh::VertexOrbits orbits = mesh::find_vertex_orbits(mesh);
  const std::vector<bool> is_end = ends_of_unlike_edges(mesh, on_walls);
  const IndexLists members_of = rows_by_key(orbits.vertices.base, mesh.num_vertices());
  walls.images = orbits.images;
  for (LocalIndex base = 0; base < mesh.num_vertices(); ++base) {
    const auto members = members_of[base];
    const auto at_one_place = std::ranges::count_if(
        members, [&](LocalIndex v) { return orbits.vertices.image_of(v) == 0; });
    // The sides of a split are walls of their own.
    if (std::cmp_equal(at_one_place, members.size())) continue;
    const auto row_of = [&](LocalIndex v) { return walls.wall_of_vertex[at(v)]; };
    const bool is_alike = at_one_place == 1 && std::ranges::all_of(members, [&](LocalIndex v) {
                            return row_of(v) != kNoIndex && !is_end[at(v)]
                                   && walls.vertices[at(row_of(v))].column != Vec3{};
                          });
    Vec3 column{};
    LocalIndex stack = 0;
    if (is_alike) {
      const WallVertex& leader = shortest(members, walls);
      column = norm(leader.column) * common_direction(members, orbits, walls);
      stack = leader.stack;
    }
    for (const LocalIndex v : members) {
      if (row_of(v) == kNoIndex) continue;
      WallVertex& vertex = walls.vertices[at(row_of(v))];
      vertex.column = Vec3{};
      vertex.stack = stack;
      if (!is_alike) continue;
      vertex.origin = row_of(base);
      vertex.image = orbits.vertices.image_of(v);
      vertex.column = orbits.images[at(vertex.image)].turned(column);
    }
  }
}

}  // namespace tessera::layers
