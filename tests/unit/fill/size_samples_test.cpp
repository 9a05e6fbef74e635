// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/size_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/subdomain_tets.hpp"

#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::fill {
namespace {

struct SamplesOfCube : ::testing::Test {
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const mesh::Decomposition decomposition = testing::slabs(cube, 2);
  const IndexLists tets = mesh::subdomain_tets(decomposition);

  [[nodiscard]] FillInput samples(LocalIndex subdomain, int levels) const
  {
    FillInput input;
    add_size_samples(cube, tets[subdomain], vertex_sizes(cube, levels), levels, input);
    return input;
  }

  // Whether a point is strictly inside some tet of a subdomain.
  [[nodiscard]] bool is_inside(const Vec3& p, LocalIndex subdomain) const
  {
    for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
      if (decomposition.tet_subdomain[static_cast<std::size_t>(t)] != subdomain) continue;
      std::array<Vec3, 4> c;
      for (std::size_t i = 0; i < 4; ++i) c[i] = cube.position(cube.tet(t)[i]);
      if (tet_volume(p, c[1], c[2], c[3]) > 0.0 && tet_volume(c[0], p, c[2], c[3]) > 0.0
          && tet_volume(c[0], c[1], p, c[3]) > 0.0 && tet_volume(c[0], c[1], c[2], p) > 0.0) {
        return true;
      }
    }
    return false;
  }
};

TEST_F(SamplesOfCube, ArePositiveAndInside)
{
  for (LocalIndex s = 0; s < 2; ++s) {
    const FillInput input = samples(s, 1);
    ASSERT_FALSE(input.size_h.empty());
    ASSERT_EQ(input.size_xyz.size(), 3 * input.size_h.size());
    for (std::size_t i = 0; i < input.size_h.size(); ++i) {
      EXPECT_GT(input.size_h[i], 0.0);
      EXPECT_TRUE(is_inside(point_at(std::span<const double>(input.size_xyz), i), s));
    }
  }
}

// One size everywhere: the samples have it too, and there are more of them with every level.
TEST_F(SamplesOfCube, HaveTheSizeOfTheVertices)
{
  const std::vector<double> size(static_cast<std::size_t>(cube.num_vertices()), 0.75);
  std::size_t fewer = 0;
  for (int levels = 0; levels < 4; ++levels) {
    FillInput input;
    add_size_samples(cube, tets[0], size, levels, input);
    EXPECT_GT(input.size_h.size(), fewer);
    fewer = input.size_h.size();
    for (const double h : input.size_h) EXPECT_NEAR(h, 0.75, 1e-15);
  }
}

// A size that is linear in space comes back at every sample.
TEST_F(SamplesOfCube, InterpolateBetweenVertices)
{
  const auto linear = [](const Vec3& p) { return 2.0 + p[0] - 0.5 * p[1] + 0.25 * p[2]; };
  std::vector<double> size;
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) size.push_back(linear(cube.position(v)));
  FillInput input;
  add_size_samples(cube, tets[1], size, 2, input);
  ASSERT_FALSE(input.size_h.empty());
  for (std::size_t i = 0; i < input.size_h.size(); ++i) {
    const Vec3 p = point_at(std::span<const double>(input.size_xyz), i);
    EXPECT_NEAR(input.size_h[i], linear(p), 1e-15);
  }
}

// No place is far from a sample: at most an edge of the refined mesh.
TEST_F(SamplesOfCube, AreNoFurtherApartThanTheWantedEdge)
{
  constexpr int kLevels = 2;
  const FillInput input = samples(0, kLevels);
  const mesh::CoarseMesh probes = testing::kuhn_cube(7);
  for (LocalIndex v = 0; v < probes.num_vertices(); ++v) {
    const Vec3 p = probes.position(v);
    if (p[1] > 0.5) continue;
    double nearest = 10.0;
    double h = 0.0;
    for (std::size_t i = 0; i < input.size_h.size(); ++i) {
      const double away = norm(point_at(std::span<const double>(input.size_xyz), i) - p);
      if (away < nearest) h = input.size_h[i];
      nearest = std::min(nearest, away);
    }
    EXPECT_LE(nearest, h);
  }
}

// Of kuhn_cube(1), vertex 0 is on the long diagonal: six tets with edges 1, sqrt 2 and sqrt 3
// there.
TEST(VertexSizes, AreTheMeanEdgeOfTheTetsAround)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(1);
  const std::vector<double> sizes = vertex_sizes(cube, 0);
  ASSERT_EQ(sizes.size(), 8U);
  EXPECT_NEAR(sizes[0], (1.0 + std::sqrt(2.0) + std::sqrt(3.0)) / 3.0, 1e-15);
  for (const double size : sizes) {
    EXPECT_GE(size, 1.0);
    EXPECT_LE(size, std::sqrt(3.0));
  }
}

TEST(VertexSizes, OfUnusedVerticesAreZero)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(1);
  cube.vertex_xyz.insert(cube.vertex_xyz.end(), {9, 9, 9});
  EXPECT_EQ(vertex_sizes(cube, 0).back(), 0.0);
}

TEST_F(SamplesOfCube, AreAddedToWhatIsThere)
{
  FillInput input;
  input.vertex_xyz = {1, 2, 3};
  input.size_xyz = {7, 8, 9};
  input.size_h = {0.5};
  add_size_samples(cube, tets[0], vertex_sizes(cube, 2), 2, input);
  EXPECT_EQ(input.vertex_xyz, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(input.size_h.front(), 0.5);
  EXPECT_EQ(input.size_xyz.size(), 3 * input.size_h.size());
  EXPECT_EQ(input.size_h.size(), 1 + samples(0, 2).size_h.size());
}

TEST_F(SamplesOfCube, OfNoTetsAreNone)
{
  FillInput input;
  add_size_samples(cube, {}, vertex_sizes(cube, 1), 1, input);
  EXPECT_TRUE(input.size_h.empty());
}

}  // namespace
}  // namespace tessera::fill
