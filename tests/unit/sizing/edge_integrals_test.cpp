// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/tet_edges.hpp"
#include "tessera/sizing/size_field.hpp"

#include "support/meshes.hpp"

namespace tessera::sizing {
namespace {

using testing::kuhn_cube;

std::vector<LocalIndex> all_edges(const mesh::CoarseMesh& coarse)
{
  std::vector<LocalIndex> edges;
  mesh::for_each_edge(coarse.tet_vertices, coarse.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    edges.push_back(a);
    edges.push_back(b);
  });
  return edges;
}

// The edge of kuhn_cube(1) from the origin to (1, 0, 0), stretched to `length`.
struct OneEdge {
  mesh::CoarseMesh coarse;
  std::vector<LocalIndex> vertices;
};

OneEdge edge_along_x(double length)
{
  OneEdge edge{kuhn_cube(1), {}};
  for (const Vec3& end : {Vec3{0.0, 0.0, 0.0}, Vec3{1.0, 0.0, 0.0}}) {
    for (LocalIndex v = 0; v < edge.coarse.num_vertices(); ++v) {
      if (edge.coarse.position(v) == end) edge.vertices.push_back(v);
    }
  }
  for (double& x : edge.coarse.vertex_xyz) x *= length;
  return edge;
}

double integral(const OneEdge& edge, const SizeOptions& options)
{
  return edge_size_integrals(edge.coarse, edge.vertices, SizeField(options, edge.coarse)).at(0);
}

TEST(EdgeSizeIntegrals, OfOneSizeAreTheLengthsOverIt)
{
  const mesh::CoarseMesh cube = kuhn_cube(3);
  const std::vector<LocalIndex> edges = all_edges(cube);
  const std::vector<double> integrals =
      edge_size_integrals(cube, edges, SizeField({.target = 0.125}, cube));
  ASSERT_EQ(2 * integrals.size(), edges.size());
  ASSERT_FALSE(integrals.empty());
  for (std::size_t e = 0; e < integrals.size(); ++e) {
    const double length = norm(cube.position(edges[2 * e + 1]) - cube.position(edges[2 * e]));
    EXPECT_NEAR(integrals[e], length / 0.125, 1e-13);
  }
}

TEST(EdgeSizeIntegrals, WithoutAWantedSizeAreZero)
{
  const OneEdge edge = edge_along_x(1.0);
  EXPECT_EQ(integral(edge, {}), 0.0);
}

TEST(EdgeSizeIntegrals, OfAGrowingSizeAreLogarithms)
{
  // Half-space x < 0: the size along the edge is 0.01 + growth * x.
  for (const double growth : {0.05, 0.3, 1.0}) {
    const SizeOptions options{
        .regions = {{HalfSpace{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 0.01, growth}}};
    const double wanted = std::log1p(growth * 2.0 / 0.01) / growth;
    EXPECT_NEAR(integral(edge_along_x(2.0), options), wanted, 1e-4 * wanted) << growth;
  }
}

TEST(EdgeSizeIntegrals, SeeASmallBallInTheMiddleOfALongEdge)
{
  constexpr double kSize = 0.02;
  constexpr double kRadius = 0.05;
  constexpr double kGrowth = 0.3;
  for (const double middle : {50.0, 37.123, 81.7}) {
    const SizeOptions options{.target = 100.0,
                              .regions = {{Ball{{middle, 0.0, 0.0}, kRadius}, kSize, kGrowth}}};
    const auto side = [&](double length) {
      return std::log1p(kGrowth * (length - kRadius) / kSize) / kGrowth;
    };
    const double wanted = 2.0 * kRadius / kSize + side(middle) + side(100.0 - middle);
    EXPECT_NEAR(integral(edge_along_x(100.0), options), wanted, 0.02 * wanted) << middle;
  }
}

TEST(EdgeSizeIntegrals, StopWhenTheEdgeIsCutOftenEnough)
{
  const SizeOptions options{.regions = {{HalfSpace{{0.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, 1e-9, 0.3}}};
  EXPECT_NEAR(integral(edge_along_x(1.0), options), 1e9, 1.0);
}

TEST(EdgeSizeIntegrals, DependOnNoOtherEdgeAndNoDirection)
{
  const mesh::CoarseMesh cube = kuhn_cube(6);
  const std::vector<LocalIndex> edges = all_edges(cube);
  const SizeField sizes({.target = 0.2, .regions = {{Ball{{0.4, 0.5, 0.6}, 0.1}, 0.003, 0.4}}},
                        cube);
  const std::vector<double> together = edge_size_integrals(cube, edges, sizes);
  for (std::size_t e = 0; e < together.size(); e += 7) {
    const std::vector<LocalIndex> reversed{edges[2 * e + 1], edges[2 * e]};
    EXPECT_EQ(edge_size_integrals(cube, reversed, sizes).at(0), together[e]);
  }
}

}  // namespace
}  // namespace tessera::sizing
