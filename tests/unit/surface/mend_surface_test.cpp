// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/mend_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/surface/mend_folds.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::surface {
namespace {

// Turns the faces of a convex body outward.
void turn_outward(mesh::CoarseMesh& mesh)
{
  Vec3 centre{};
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    centre = centre + (1.0 / mesh.num_vertices()) * mesh.position(v);
  }
  for (std::size_t f = 0; f < mesh.face_patch.size(); ++f) {
    LocalIndex* v = &mesh.face_vertices[3 * f];
    const Vec3 a = mesh.position(v[0]);
    const Vec3 normal = cross(mesh.position(v[1]) - a, mesh.position(v[2]) - a);
    if (dot(normal, a - centre) > 0.0) continue;
    std::swap(v[1], v[2]);
    if (mesh.face_uv.empty()) continue;
    for (const std::size_t k : {2U, 3U})
      std::swap(mesh.face_uv[6 * f + k], mesh.face_uv[6 * f + k + 2]);
  }
}

// The surface of a mesh, its material as the one domain.
CoarseSurface surface_of(mesh::CoarseMesh mesh)
{
  CoarseSurface surface;
  turn_outward(mesh);
  mesh.tet_vertices.clear();
  mesh.tet_material.clear();
  surface.face_domains.assign(at(mesh.num_faces()), {1, 0});
  surface.domain_material = {1};
  surface.domain_max_size = {1.0};
  surface.mesh = std::move(mesh);
  return surface;
}

double smallest_angle_deg(const CoarseSurface& surface)
{
  double least = 180.0;
  for (std::size_t corner = 0; corner < surface.mesh.face_vertices.size(); ++corner) {
    const std::size_t first = corner - corner % 3;
    const auto point = [&](std::size_t c) {
      return surface.mesh.position(surface.mesh.face_vertices[first + c % 3]);
    };
    const Vec3 u = point(corner + 1 - first) - point(corner - first);
    const Vec3 v = point(corner + 2 - first) - point(corner - first);
    least = std::min(least, std::atan2(norm(cross(u, v)), dot(u, v)));
  }
  return least * 180.0 / std::numbers::pi;
}

std::map<LocalIndex, double> areas_of(const CoarseSurface& surface)
{
  std::map<LocalIndex, double> areas;
  for (LocalIndex f = 0; f < surface.mesh.num_faces(); ++f) {
    const LocalIndex* v = &surface.mesh.face_vertices[3 * at(f)];
    const Vec3 a = surface.mesh.position(v[0]);
    areas[surface.mesh.face_patch[at(f)]] +=
        0.5 * norm(cross(surface.mesh.position(v[1]) - a, surface.mesh.position(v[2]) - a));
  }
  return areas;
}

// Each edge has one triangle on either side, and each segment is an edge.
void expect_closed(const CoarseSurface& surface)
{
  std::set<std::array<LocalIndex, 2>> sides;
  const FlatArray<LocalIndex>& v = surface.mesh.face_vertices;
  for (std::size_t corner = 0; corner < v.size(); ++corner) {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    EXPECT_TRUE(sides.insert({v[corner], v[next]}).second);
  }
  for (const auto& [a, b] : sides) EXPECT_TRUE(sides.contains({b, a}));
  for (LocalIndex s = 0; s < surface.mesh.num_segments(); ++s) {
    const LocalIndex* ends = &surface.mesh.segment_vertices[2 * at(s)];
    EXPECT_TRUE(sides.contains({ends[0], ends[1]}));
  }
}

bool has_vertex_at(const CoarseSurface& surface, const Vec3& point)
{
  return std::ranges::any_of(surface.mesh.face_vertices, [&](LocalIndex v) {
    return norm(surface.mesh.position(v) - point) < 1e-12;
  });
}

LocalIndex vertex_at(const CoarseSurface& surface, const Vec3& point)
{
  for (LocalIndex v = 0; v < surface.mesh.num_vertices(); ++v) {
    if (norm(surface.mesh.position(v) - point) < 1e-12) return v;
  }
  ADD_FAILURE() << "no vertex there";
  return 0;
}

void move(CoarseSurface& surface, const Vec3& from, const Vec3& to)
{
  std::ranges::copy(to, &surface.mesh.vertex_xyz[3 * at(vertex_at(surface, from))]);
}

CoarseSurface cube(int n) { return surface_of(testing::kuhn_cube(n)); }

TEST(MendSurface, LeavesAGoodSurfaceAsItIs)
{
  CoarseSurface surface = cube(4);
  const CoarseSurface before = surface;
  EXPECT_EQ(mend_surface(surface, testing::FlatModel()).total(), 0);
  EXPECT_EQ(surface.mesh.face_vertices, before.mesh.face_vertices);
  EXPECT_EQ(surface.mesh.vertex_xyz, before.mesh.vertex_xyz);
}

TEST(MendSurface, MendsATriangleThatAVertexInAFaceSpoils)
{
  for (const Vec3& to : {Vec3{0.5, 0.49, 0.0}, Vec3{0.26, 0.02, 0.0}, Vec3{0.49, 0.25, 0.0},
                         Vec3{0.375, 0.002, 0.0}}) {
    CoarseSurface surface = cube(4);
    move(surface, {0.25, 0.25, 0.0}, to);
    ASSERT_LT(smallest_angle_deg(surface), 10.0);
    EXPECT_GT(mend_surface(surface, testing::FlatModel()).total(), 0);
    EXPECT_GT(smallest_angle_deg(surface), 15.0) << to[0] << ' ' << to[1];
    expect_closed(surface);
    for (const auto& [patch, area] : areas_of(surface)) {
      EXPECT_NEAR(area, 1.0, 1e-12) << patch;
    }
    for (const double x : {0.0, 1.0}) EXPECT_TRUE(has_vertex_at(surface, {x, 0.0, 0.0}));
  }
}

TEST(MendSurface, MendsShortEdgesOfACurve)
{
  CoarseSurface surface = cube(4);
  move(surface, {0.5, 0.0, 0.0}, {0.27, 0.0, 0.0});
  ASSERT_LT(smallest_angle_deg(surface), 10.0);
  const MendStatistics done = mend_surface(surface, testing::FlatModel());
  EXPECT_GT(done.num_collapses + done.num_moves, 0);
  EXPECT_GT(smallest_angle_deg(surface), 15.0);
  expect_closed(surface);
  for (const auto& [patch, area] : areas_of(surface)) EXPECT_NEAR(area, 1.0, 1e-12) << patch;
}

TEST(MendSurface, PutsWhatItMovesOntoTheGeometry)
{
  CoarseSurface surface = surface_of(testing::ball(4));
  mesh::CoarseMesh& mesh = surface.mesh;
  const LocalIndex* v = mesh.face_vertices.data();
  const Vec3 between = 0.97 * mesh.position(v[0]) + 0.03 * mesh.position(v[1]);
  std::ranges::copy((1.0 / norm(between)) * between, &mesh.vertex_xyz[3 * at(v[1])]);
  ASSERT_LT(smallest_angle_deg(surface), 10.0);
  EXPECT_GT(mend_surface(surface, testing::SphereModel({1.0})).total(), 0);
  EXPECT_GT(smallest_angle_deg(surface), 12.0);
  expect_closed(surface);
  for (const LocalIndex corner : mesh.face_vertices) {
    EXPECT_NEAR(norm(mesh.position(corner)), 1.0, 1e-12);
  }
}

TEST(MendSurface, KeepsParametersOfWhatChanges)
{
  const testing::CylinderModel model;
  CoarseSurface surface = surface_of(testing::cylinder(4));
  mesh::CoarseMesh& mesh = surface.mesh;
  // A vertex of the mantle, off its curves, comes near another one.
  const LocalIndex v = vertex_at(surface, {1.0, 0.0, 0.5});
  const Vec3 near{std::cos(0.74), std::sin(0.74), 0.5};
  std::ranges::copy(near, &mesh.vertex_xyz[3 * at(v)]);
  EXPECT_GT(mend_surface(surface, model).total(), 0);
  expect_closed(surface);
  ASSERT_EQ(mesh.face_uv.size(), 6 * at(mesh.num_faces()));
  EXPECT_EQ(mesh.segment_t.size(), mesh.segment_vertices.size());
  for (std::size_t corner = 0; corner < mesh.face_vertices.size(); ++corner) {
    const model::SurfaceParameters uv{mesh.face_uv[2 * corner], mesh.face_uv[2 * corner + 1]};
    const Vec3 point = mesh.position(mesh.face_vertices[corner]);
    const LocalIndex number = mesh.patch_surface[at(mesh.face_patch[corner / 3])];
    const model::SurfacePoint found = model.project_to_surface(number, point, uv);
    EXPECT_NEAR(found.uv[0], uv[0], 1e-9);
    EXPECT_NEAR(found.uv[1], uv[1], 1e-9);
  }
}

// A cube with a dent all along z: its side y0 and the curves there are at y = height(x), where x is
// below 0.5.
class DentedCube final : public model::Model {
 public:
  explicit DentedCube(double depth) : depth_(depth) {}

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters&) const override
  {
    return {surface == dented_surface_ ? dented(point) : point, {}};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3& point,
                                                   double) const override
  {
    return {
        point[1] < 0.5 * depth_ + 0.01 && point[0] > 0.0 && point[0] < 1.0 ? dented(point) : point,
        0.0};
  }
  [[nodiscard]] double box_diagonal() const override { return std::sqrt(3.0); }

  [[nodiscard]] Vec3 dented(const Vec3& p) const
  {
    const double wave = std::sin(2.0 * std::numbers::pi * p[0]);
    return {p[0], p[0] < 0.5 ? depth_ * wave * wave : 0.0, p[2]};
  }

  LocalIndex dented_surface_ = 2;

 private:
  double depth_;
};

TEST(MendFolds, LeavesASoundSurfaceAsItIs)
{
  CoarseSurface surface = surface_of(testing::ball(4));
  const CoarseSurface before = surface;
  EXPECT_EQ(mend_folds(surface, testing::SphereModel({1.0})).num_before, 0);
  EXPECT_EQ(surface.mesh.face_vertices, before.mesh.face_vertices);
}

// Their corner between the sides opens to 180 degrees as levels are added.
TEST(MendFolds, NoTriangleKeepsTwoSidesOnACircle)
{
  CoarseSurface surface = surface_of(testing::cylinder(4));
  const auto num_left = [&] {
    const FoldStatistics done = mend_folds(surface, testing::CylinderModel());
    EXPECT_EQ(done.num_before, 0) << "none folds on the first level";
    return done.num_flips + done.num_cuts;
  };
  EXPECT_GE(num_left(), 4);
  expect_closed(surface);
  EXPECT_EQ(num_left(), 0);
}

// In the first case the arc ends beyond its triangle, in the second within it.
TEST(MendFolds, CutsAnArcThatIsHigherThanItsTriangle)
{
  for (const bool is_within : {false, true}) {
    CoarseSurface surface = cube(2);
    const DentedCube model(is_within ? 0.25 : 0.3);
    for (const double z : {0.0, 1.0}) {
      if (is_within) move(surface, {0.5, 0.5, z}, {0.25, 0.32, z});
    }
    const FoldStatistics done = mend_folds(surface, model);
    EXPECT_GT(done.num_before, 0);
    EXPECT_EQ(done.num_left, 0);
    EXPECT_GT(done.num_cuts, 0);
    expect_closed(surface);
    for (const double z : {0.0, 1.0}) {
      EXPECT_TRUE(has_vertex_at(surface, model.dented({0.25, 0.0, z})));
    }
    EXPECT_EQ(mend_folds(surface, model).num_before, 0);
  }
}

// The child in the middle keeps a fifth of its height: no fold, but a needle.
TEST(MendFolds, CutsAnArcThatIsNearlyAsHighAsItsTriangle)
{
  CoarseSurface surface = cube(2);
  const DentedCube model(0.08);
  for (const double z : {0.0, 1.0}) move(surface, {0.5, 0.5, z}, {0.25, 0.2, z});
  const FoldStatistics done = mend_folds(surface, model);
  EXPECT_EQ(done.num_before, 0);
  EXPECT_GT(done.num_flips + done.num_cuts, 0);
  expect_closed(surface);
}

}  // namespace
}  // namespace tessera::surface
