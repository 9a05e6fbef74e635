// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/folded_children.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kThickness = 0.05;

mesh::CoarseMesh plate()
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(2);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) mesh.vertex_xyz[3 * at(v) + 2] *= kThickness;
  return mesh;
}

// A bottom that goes through all vertices of the plate, and between them up to a height.
testing::GraphModel waves(double height)
{
  return testing::GraphModel([height](double x, double) {
    const double wave = std::sin(2.0 * std::numbers::pi * x);
    return height * wave * wave;
  });
}

TEST(FoldedChildren, AreNoneOnTheGeometryItself)
{
  EXPECT_TRUE(sizes_of_folds(plate(), waves(0.0)).size.empty());
  EXPECT_TRUE(sizes_of_folds(testing::ball(4), testing::SphereModel({1.0})).size.empty());
}

TEST(FoldedChildren, AreNoneWhereSheetsStayApart)
{
  EXPECT_TRUE(sizes_of_folds(plate(), waves(0.5 * kThickness)).size.empty());
}

TEST(FoldedChildren, AskForShorterEdgesWhereOneSheetGoesThroughAnother)
{
  const mesh::SizePoints sizes = sizes_of_folds(plate(), waves(2.0 * kThickness));
  ASSERT_FALSE(sizes.size.empty());
  ASSERT_EQ(sizes.xyz.size(), 3 * sizes.size.size());
  const double longest = std::hypot(0.5, 0.5);
  for (const double size : sizes.size) EXPECT_LE(size, 0.5 * longest * (1.0 + 1e-12));
  for (const double size : sizes.size) EXPECT_GT(size, 0.0);
}

TEST(FoldedChildren, AskForShorterEdgesWhereATriangleTurnsOver)
{
  mesh::CoarseMesh ball = testing::ball(4);
  const LocalIndex v = ball.face_vertices.front();  // Between its neighbours, off the sphere.
  for (std::size_t axis = 0; axis < 3; ++axis) ball.vertex_xyz[3 * at(v) + axis] *= 0.3;
  EXPECT_FALSE(sizes_of_folds(ball, testing::SphereModel({1.0})).size.empty());
}

}  // namespace
}  // namespace tessera::coarse
