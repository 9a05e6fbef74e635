// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/distributed_mesh.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/distributed_meshes.hpp"
#include "support/meshes.hpp"

namespace tessera::migrate {
namespace {

MeshBlock cube()
{
  const mesh::CoarseMesh mesh = testing::kuhn_cube(2);
  const std::vector<Rank> all_here(at(mesh.num_tets()), 0);
  return testing::share_of_mesh(mesh, all_here, 0);
}

void swap_first_two_tets(MeshBlock& block)
{
  std::swap_ranges(block.tet_vertices.begin(), block.tet_vertices.begin() + 4,
                   block.tet_vertices.begin() + 4);
  std::swap(block.tet_material[0], block.tet_material[1]);
}

TEST(DigestOfTets, TellsMaterialsApart)
{
  MeshBlock block = cube();
  const Hash128 digest = digest_of_tets(block);
  ++block.tet_material[0];
  EXPECT_NE(digest_of_tets(block), digest);
}

TEST(DigestOfTets, TellsPositionsApart)
{
  MeshBlock block = cube();
  const Hash128 digest = digest_of_tets(block);
  block.vertex_xyz[3 * at(block.tet_vertices[0])] += 1e-9;
  EXPECT_NE(digest_of_tets(block), digest);
}

TEST(DigestOfTets, MissesATet)
{
  MeshBlock block = cube();
  const Hash128 digest = digest_of_tets(block);
  block.tet_ids.pop_back();
  block.tet_material.pop_back();
  block.tet_vertices.resize(block.tet_vertices.size() - 4);
  EXPECT_NE(digest_of_tets(block), digest);
}

TEST(DigestOfTets, DependsOnNeitherOrderNorIds)
{
  MeshBlock block = cube();
  const Hash128 digest = digest_of_tets(block);
  swap_first_two_tets(block);
  for (GlobalIndex& id : block.tet_ids) id += 12345;
  for (GlobalIndex& id : block.vertex_ids) id += 54321;
  EXPECT_EQ(digest_of_tets(block), digest);
}

}  // namespace
}  // namespace tessera::migrate
