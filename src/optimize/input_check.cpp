// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/input_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::optimize {
namespace {

void require(bool is_valid, const std::string& what)
{
  if (!is_valid) throw MeshError(what);
}

// Of four vertices.
bool has_vertex_twice(const LocalIndex* v)
{
  return (v[0] == v[1]) | (v[0] == v[2]) | (v[0] == v[3]) | (v[1] == v[2]) | (v[1] == v[3])
         | (v[2] == v[3]);
}

void require_sizes(const TetMesh& mesh)
{
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<LocalIndex>::max());
  const std::size_t num_vertices = mesh.vertex_xyz.size() / 3;
  const auto fits = [](std::size_t size, std::size_t wanted) {
    return size == 0 || size == wanted;
  };
  require(mesh.vertex_xyz.size() % 3 == 0, "coordinates of vertices are not three each");
  require(mesh.tet_vertices.size() % 4 == 0, "vertices of tets are not four each");
  require(mesh.tet_vertices.size() < kMost && num_vertices < kMost,
          "too many tets or vertices for 32-bit indices");
  require(fits(mesh.vertex_fixed.size(), num_vertices), "flags of fixed vertices are not one each");
  require(fits(mesh.tet_neighbours.size(), mesh.tet_vertices.size()),
          "neighbours of tets are not four each");
  require(mesh.outer_triangles.size() % 3 == 0, "vertices of outer triangles are not three each");
  require(fits(mesh.outer_group.size(), mesh.outer_triangles.size() / 3),
          "groups of outer triangles are not one each");
}

// Which corner is no vertex, or stands in a tet twice, is only looked for where something is wrong.
[[noreturn]] void fail_at_corners(const TetMesh& mesh, LocalIndex num_vertices)
{
  for (std::size_t i = 0; i < mesh.tet_vertices.size(); ++i) {
    const LocalIndex v = mesh.tet_vertices[i];
    if (v >= 0 && v < num_vertices) continue;
    throw MeshError(fmt::format("tet {} has vertex {} of {}", i / 4, v, num_vertices));
  }
  for (std::size_t t = 0;; ++t) {
    if (has_vertex_twice(&mesh.tet_vertices[4 * t]))
      throw MeshError(fmt::format("tet {} has a vertex twice", t));
  }
}

// Without a branch a tet: this is looked at before each smoothing of millions of tets.
void require_corners(const TetMesh& mesh)
{
  const auto num_vertices = static_cast<LocalIndex>(mesh.vertex_xyz.size() / 3);
  bool is_wrong = false;
  for (std::size_t i = 0; i < mesh.tet_vertices.size(); i += 4) {
    const LocalIndex* v = &mesh.tet_vertices[i];
    for (std::size_t c = 0; c < 4; ++c) is_wrong |= v[c] < 0 || v[c] >= num_vertices;
    is_wrong |= has_vertex_twice(v);
  }
  if (is_wrong) fail_at_corners(mesh, num_vertices);
}

void require_outer_in_range(const TetMesh& mesh)
{
  const auto num_vertices = static_cast<LocalIndex>(mesh.vertex_xyz.size() / 3);
  const auto is_known = [&](LocalIndex v) { return v >= 0 && v < num_vertices; };
  require(std::ranges::all_of(mesh.outer_triangles, is_known),
          "an outer triangle has a vertex that the mesh does not have");
  const auto is_number = [](LocalIndex group) {
    return group >= 0 && group < std::numeric_limits<LocalIndex>::max();
  };
  require(std::ranges::all_of(mesh.outer_group, is_number),
          "a group of outer triangles is less than 0, or too large");
}

// Where a coordinate is not finite, or so large that lengths would not be.
[[noreturn]] void fail_at_coordinate(const TetMesh& mesh, std::size_t coordinate)
{
  const auto v = static_cast<LocalIndex>(coordinate / 3);
  const auto corner = std::find(mesh.tet_vertices.begin(), mesh.tet_vertices.end(), v);
  const std::string whose =
      corner == mesh.tet_vertices.end()
          ? ", of no tet,"
          : fmt::format(" of tet {}", (corner - mesh.tet_vertices.begin()) / 4);
  throw MeshError(fmt::format("vertex {}{} is not finite", v, whose));
}

void require_finite(const TetMesh& mesh)
{
  constexpr double kLargest = 1e300;
  for (std::size_t i = 0; i < mesh.vertex_xyz.size(); ++i) {
    if (!(std::abs(mesh.vertex_xyz[i]) < kLargest)) fail_at_coordinate(mesh, i);
  }
}

}  // namespace

void require_valid_arrays(const TetMesh& mesh)
{
  require_sizes(mesh);
  require_corners(mesh);
  require_outer_in_range(mesh);
  require_finite(mesh);
}

}  // namespace tessera::optimize
