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
  const FlatArray<double> before = ball.vertex_xyz;
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
  EXPECT_EQ(found.largest_off, found.largest);
  EXPECT_EQ(found.farthest_off, ball.position(v));
  EXPECT_EQ(found.scaled(10.0).farthest_off, 10.0 * ball.position(v));
  EXPECT_EQ(found.scaled(10.0).largest_off, 10.0 * found.largest_off);
}

TEST_F(SnapVertices, CountsApartWhatWasMerged)
{
  const LocalIndex v = pull_out(1.01);
  const testing::LazyModel lazy(sphere, 0.5);
  surface::Defeatured merged{.tolerance = 0.02, .places = {ball.position(v)}};
  VertexDistance found = snap_vertices(ball, lazy, merged);
  EXPECT_EQ(found.num_off, 0);
  EXPECT_EQ(found.num_merged, 1);
  EXPECT_NEAR(found.largest_merged, 0.5 * 0.005, 1e-12);
  EXPECT_EQ(found.largest, found.largest_merged);
  merged.tolerance = 1e-4;
  found = snap_vertices(ball, lazy, merged);
  EXPECT_EQ(found.num_off, 1) << "farther off than the tolerance";
  EXPECT_EQ(found.num_merged, 0);
}

TEST_F(SnapVertices, ATinyPartOfAnEdgeIsWithinTolerance)
{
  static_cast<void>(pull_out(1.0 + 1e-5));
  const VertexDistance found = snap_vertices(ball, testing::LazyModel(sphere, 0.5));
  EXPECT_EQ(found.num_off, 0);
  EXPECT_EQ(found.num_within, 1);
  EXPECT_NEAR(found.largest_within, 0.25e-5, 1e-10);
  EXPECT_EQ(found.largest, found.largest_within);
}

// The first vertex of a segment is a CAD vertex, which is less exact than its curves.
class LooseModel final : public model::Model {
 public:
  LooseModel(const model::Model& exact, double tolerance) : exact_(exact), tolerance_(tolerance) {}

  [[nodiscard]] bool has_parameters() const override { return exact_.has_parameters(); }
  [[nodiscard]] double surface_tolerance(LocalIndex s) const override
  {
    return exact_.surface_tolerance(s);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex c) const override
  {
    return exact_.curve_tolerance(c);
  }
  [[nodiscard]] double end_tolerance(LocalIndex, const Vec3&) const override { return tolerance_; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex s, const Vec3& p, const model::SurfaceParameters& guess) const override
  {
    return exact_.project_to_surface(s, p, guess);
  }
  // A curve that is a hundredth beside every point.
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3& p, double) const override
  {
    return {p + Vec3{0.01, 0.0, 0.0}, 0.0};
  }
  [[nodiscard]] double box_diagonal() const override { return exact_.box_diagonal(); }

 private:
  const model::Model& exact_;
  double tolerance_;
};

TEST_F(SnapVertices, AnEndOfACurveMayBeOffByTheToleranceOfItsCadVertex)
{
  const LocalIndex v = ball.face_vertices.front();
  ball.segment_vertices = {v, ball.face_vertices[1]};
  ball.segment_curve = {0};
  ball.segment_t.clear();
  const VertexDistance loose = snap_vertices(ball, LooseModel(sphere, 0.02));
  EXPECT_EQ(loose.num_off, 0);
  EXPECT_EQ(loose.num_within, 2);
  EXPECT_NEAR(loose.largest_within, 0.01, 1e-12);
  const VertexDistance exact = snap_vertices(ball, LooseModel(sphere, 0.005));
  EXPECT_EQ(exact.num_off, 2);
  EXPECT_EQ(exact.num_within, 0);
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
