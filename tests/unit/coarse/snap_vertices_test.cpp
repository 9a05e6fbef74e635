// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/snap_vertices.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"

namespace tessera::coarse {
namespace {

struct SnapVertices : ::testing::Test {
  mesh::CoarseMesh ball = testing::ball(4);
  const testing::SphereModel sphere{{1.0}};

  // Moves the first vertex on the sphere along its radius.
  LocalIndex pull_out(double factor)
  {
    const LocalIndex v = ball.face_vertices.front();
    for (std::size_t axis = 0; axis < 3; ++axis) ball.vertex_xyz[3 * at(v) + axis] *= factor;
    return v;
  }
};

TEST_F(SnapVertices, LeavesASoundMeshAsItIs)
{
  const std::vector<double> before = ball.vertex_xyz;
  const VertexDistance found = snap_vertices(ball, sphere);
  EXPECT_EQ(found.num_off, 0);
  EXPECT_LE(found.largest, 1e-15);
  EXPECT_EQ(ball.vertex_xyz, before);
}

TEST_F(SnapVertices, PutsAVertexBackOntoItsSurface)
{
  const LocalIndex v = pull_out(1.01);
  const VertexDistance found = snap_vertices(ball, sphere);
  EXPECT_EQ(found.num_off, 0);
  EXPECT_NEAR(norm(ball.position(v)), 1.0, 1e-14);
  EXPECT_NO_THROW(mesh::validate(ball));
}

TEST_F(SnapVertices, CountsWhatCannotBePutThere)
{
  const LocalIndex v = pull_out(1.01);
  const testing::LazyModel lazy(sphere, 0.5);
  const VertexDistance found = snap_vertices(ball, lazy);
  EXPECT_EQ(found.num_off, 1);
  EXPECT_NEAR(found.largest, 0.5 * 0.005, 1e-12) << "half of the half that is left";
  EXPECT_NEAR(norm(ball.position(v)), 1.005, 1e-12);
}

TEST_F(SnapVertices, DoesNotFoldATet)
{
  // On a sphere of a hundredth the tets at the vertex would be turned over.
  const testing::SphereModel small({0.01});
  const VertexDistance found = snap_vertices(ball, small);
  EXPECT_GT(found.num_off, 0);
  EXPECT_NEAR(found.largest, 0.99, 1e-6);
  EXPECT_NO_THROW(mesh::validate(ball));
}

}  // namespace
}  // namespace tessera::coarse
