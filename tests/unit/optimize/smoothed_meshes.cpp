// SPDX-License-Identifier: BSD-3-Clause
#include "smoothed_meshes.hpp"

#include <bit>
#include <span>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "sample_meshes.hpp"

namespace tessera::testing {

using optimize::TetMesh;

std::array<std::uint64_t, 3> bits_of(const std::vector<double>& xyz, LocalIndex v)
{
  return std::bit_cast<std::array<std::uint64_t, 3>>(point_at(std::span(xyz), v));
}

Flags boundary_flags(const TetMesh& mesh)
{
  Flags flags(mesh.vertex_xyz.size() / 3, 0);
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    for (const LocalIndex v : triangle.vertices) flags[at(v)] = 1;
  }
  return flags;
}

Flags inner_flags(const TetMesh& mesh)
{
  Flags flags = boundary_flags(mesh);
  for (std::uint8_t& flag : flags) flag = flag == 0 ? 1 : 0;
  return flags;
}

LocalIndex num_moved(const TetMesh& mesh, const Flags& may_move, const std::vector<double>& moved)
{
  EXPECT_EQ(moved.size(), mesh.vertex_xyz.size());
  LocalIndex count = 0;
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(may_move.size()); ++v) {
    const bool is_old = bits_of(moved, v) == bits_of(mesh.vertex_xyz, v);
    EXPECT_TRUE(is_old || may_move[at(v)] != 0) << "vertex " << v;
    count += is_old ? 0 : 1;
  }
  return count;
}

TetMesh squeezed(TetMesh mesh, double height)
{
  for (std::size_t i = 2; i < mesh.vertex_xyz.size(); i += 3) mesh.vertex_xyz[i] *= height;
  return mesh;
}

std::vector<TetMesh> positive_meshes()
{
  std::vector<TetMesh> meshes{subdivided_cube(2)};
  for (const unsigned seed : {21U, 22U, 23U, 24U}) {
    for (const double jitter : {0.3, 0.9}) {
      meshes.push_back(jittered_cube(5, jitter, seed));
      for (const double height : {1e-2, 1e-5}) {
        meshes.push_back(squeezed(jittered_cube(4, jitter, seed), height));
      }
    }
  }
  return meshes;
}

}  // namespace tessera::testing
