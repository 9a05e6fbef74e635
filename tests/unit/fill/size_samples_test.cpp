// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/size_samples.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::fill {
namespace {

struct SamplesOfCube : ::testing::Test {
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const mesh::Decomposition decomposition = testing::slabs(cube, 2);

  [[nodiscard]] FillInput samples(LocalIndex subdomain, int levels) const
  {
    FillInput input;
    add_size_samples(cube, decomposition, subdomain, levels, input);
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

TEST_F(SamplesOfCube, HalveWithEveryLevel)
{
  const FillInput coarse = samples(0, 0);
  for (int levels = 1; levels < 5; ++levels) {
    const FillInput fine = samples(0, levels);
    EXPECT_EQ(fine.size_xyz, coarse.size_xyz);
    for (std::size_t i = 0; i < fine.size_h.size(); ++i) {
      EXPECT_EQ(fine.size_h[i], std::ldexp(coarse.size_h[i], -levels));
    }
  }
}

// A Kuhn tet of width h has three edges h, two of h sqrt 2 and one of h sqrt 3.
TEST_F(SamplesOfCube, AreTheMeanEdgeOfTheTet)
{
  const double mean = 0.5 * (3.0 + 2.0 * std::sqrt(2.0) + std::sqrt(3.0)) / 6.0;
  for (const double size : samples(1, 0).size_h) EXPECT_NEAR(size, mean, 1e-15);
}

TEST_F(SamplesOfCube, AreAddedToWhatIsThere)
{
  FillInput input;
  input.vertex_xyz = {1, 2, 3};
  input.size_xyz = {7, 8, 9};
  input.size_h = {0.5};
  add_size_samples(cube, decomposition, 0, 2, input);
  EXPECT_EQ(input.vertex_xyz, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(input.size_h.front(), 0.5);
  EXPECT_EQ(input.size_xyz.size(), 3 * input.size_h.size());
  EXPECT_EQ(input.size_h.size(), 1 + samples(0, 2).size_h.size());
}

TEST_F(SamplesOfCube, OfASubdomainWithoutTetsAreNone) { EXPECT_TRUE(samples(5, 1).size_h.empty()); }

}  // namespace
}  // namespace tessera::fill
