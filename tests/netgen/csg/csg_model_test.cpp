// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/meshes.hpp"
#include "support/temporary_file.hpp"

namespace tessera {
namespace {

constexpr const char* kCube =
    "algebraic3d\nsolid cube = orthobrick (0, 0, 0; 1, 1, 1);\ntlo cube;\n";
constexpr const char* kSphere =
    "algebraic3d\nsolid ball = sphere (1, 2, 3; 2) -bcname=hull;\ntlo ball;\n";
constexpr const char* kCylinder =
    "algebraic3d\n"
    "solid can = cylinder (0, 0, 0; 0, 0, 1; 0.5) -bcname=side\n"
    "  ;\nsolid cut = can and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);\n"
    "tlo cut -material=steel;\n";
constexpr const char* kTorus =
    "algebraic3d\nsolid ring = torus (0, 0, 0; 0, 0, 1; 2; 1) -bcname=skin;\ntlo ring;\n";
constexpr const char* kCone =
    "algebraic3d\nsolid tip = cone (0, 0, 0; 2; 0, 0, 4; 1) -bcname=mantle;\n"
    "solid cut = tip and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 3; 0, 0, 1);\ntlo cut;\n";
constexpr const char* kTwoMaterials =
    "algebraic3d\nsolid box = orthobrick (0, 0, 0; 1, 1, 1);\n"
    "solid half = plane (0.5, 0, 0; 1, 0, 0);\n"
    "solid left = box and half;\nsolid right = box and not half;\n"
    "tlo left -material=iron;\ntlo right;\n";
constexpr const char* kExtrusion =
    "algebraic3d\ncurve2d profile = (4; 1,1; 1,-1; -1,-1; -1,1; 4; 2,1,2; 2,2,3; 2,3,4; 2,4,1);\n"
    "curve3d path = (3; 0,0,0; 5,0,0; 5,5,0; 1; 3,1,2,3);\n"
    "solid bent = extrusion (path; profile; 0,0,1)\n"
    "  and plane (0.5, 0, 0; -1, 0, 0) and plane (0, 4, 0; 0, 1, 0);\ntlo bent;\n";

struct Loaded {
  Loaded(const char* text, double max_size)
  {
    const testing::TemporaryFile file("model.geo", text);
    model = netgen::load_model(netgen::import_model(file.path(), {}));
    mesh = generate(max_size);
  }

  // Few elements a curvature radius: NETGEN's bound for a torus is far above its curvature.
  [[nodiscard]] mesh::CoarseMesh generate(double max_size, double curvature = 1.0) const
  {
    surface::CoarseOptions options;
    options.max_size = max_size;
    options.curvature = curvature;
    return netgen::make_coarse_mesher(*model)->generate(options);
  }

  // The three midpoints and the centroid of a face.
  [[nodiscard]] std::vector<Vec3> points_near(LocalIndex face) const
  {
    const auto corner = [&](std::size_t c) {
      return mesh.position(mesh.face_vertices[3 * static_cast<std::size_t>(face) + c]);
    };
    const Vec3 sum = corner(0) + corner(1) + corner(2);
    return {midpoint(corner(0), corner(1)), midpoint(corner(1), corner(2)),
            midpoint(corner(2), corner(0)), (1.0 / 3.0) * sum};
  }

  [[nodiscard]] LocalIndex surface_of(LocalIndex face) const
  {
    const auto patch = mesh.face_patch[static_cast<std::size_t>(face)];
    return mesh.patch_surface[static_cast<std::size_t>(patch)];
  }

  [[nodiscard]] const std::string& patch_name_of(LocalIndex face) const
  {
    const auto patch = mesh.face_patch[static_cast<std::size_t>(face)];
    return mesh.patch_names[static_cast<std::size_t>(patch)];
  }

  std::unique_ptr<model::Model> model;
  mesh::CoarseMesh mesh;
};

// Projects points near every face of the named patch; their distance to the surface's formula.
void expect_on_formula(const Loaded& loaded, const std::string& patch,
                       const std::function<double(const Vec3&)>& distance)
{
  int num_checked = 0;
  for (LocalIndex f = 0; f < loaded.mesh.num_faces(); ++f) {
    if (loaded.patch_name_of(f) != patch) continue;
    for (const Vec3& near : loaded.points_near(f)) {
      const Vec3 found = loaded.model->project_to_surface(loaded.surface_of(f), near, {}).xyz;
      EXPECT_LE(std::abs(distance(found)), 1e-8 * loaded.model->box_diagonal());
      EXPECT_LE(norm(found - near), 2.0 * std::abs(distance(near)) + 1e-12);
      ++num_checked;
    }
  }
  EXPECT_GT(num_checked, 0) << "no patch is named " << patch;
}

TEST(CsgCoarseMesh, FillsTheCubeExactly)
{
  const Loaded cube(kCube, 0.5);
  EXPECT_NEAR(testing::volume_of(cube.mesh), 1.0, 1e-12);
  EXPECT_EQ(cube.mesh.num_patches(), 6);
  EXPECT_EQ(cube.mesh.num_materials(), 1);
  EXPECT_EQ(
      std::set<LocalIndex>(cube.mesh.segment_curve.begin(), cube.mesh.segment_curve.end()).size(),
      12U);
  EXPECT_TRUE(cube.mesh.face_uv.empty());
  EXPECT_TRUE(cube.mesh.segment_t.empty());
}

TEST(CsgCoarseMesh, IsValidForEveryModel)
{
  for (const char* text : {kCube, kSphere, kCylinder, kTorus, kCone, kTwoMaterials, kExtrusion}) {
    EXPECT_NO_THROW(mesh::validate(Loaded(text, 1.0).mesh)) << text;
  }
}

// NETGEN's bound of curvature depends on the unit of length. The second torus has a narrow hole,
// and a plane cuts it.
TEST(CsgCoarseMesh, IsTheSameForATorusOfAnotherScale)
{
  const std::array<std::array<const char*, 2>, 2> kScales{
      {{"torus (0, 0, 0; 0, 0, 1; 2; 1)", "torus (0, 0, 0; 0, 0, 1; 0.2; 0.1)"},
       {"torus (0, 0, 0; 0, 0, 1; 1.4; 1) and plane (0, 0, 0.5; 0, 0, 1)",
        "torus (0, 0, 0; 0, 0, 1; 0.14; 0.1) and plane (0, 0, 0.05; 0, 0, 1)"}}};
  for (const auto& [large, small] : kScales) {
    const auto num_tets_of = [](const std::string& solid, double size) {
      const std::string text = "algebraic3d\nsolid ring = " + solid + ";\ntlo ring;\n";
      const testing::TemporaryFile file("model.geo", text);
      const auto model = netgen::load_model(netgen::import_model(file.path(), {}));
      surface::CoarseOptions options;
      options.max_size = size;
      options.surface_mesher = surface::SurfaceMesher::remesh;
      return netgen::make_coarse_mesher(*model)->generate(options).num_tets();
    };
    const LocalIndex num_tets = num_tets_of(large, 1.0);
    EXPECT_NEAR(num_tets_of(small, 0.1), num_tets, 0.1 * num_tets) << small;
  }
}

TEST(CsgCoarseMesh, UsesEveryVertexInATet)
{
  const Loaded ball(kSphere, 1.0);
  const std::set<LocalIndex> used(ball.mesh.tet_vertices.begin(), ball.mesh.tet_vertices.end());
  EXPECT_EQ(used.size(), static_cast<std::size_t>(ball.mesh.num_vertices()));
}

TEST(CsgCoarseMesh, IsTheSameOnEveryCallAndAfterOthers)
{
  const Loaded can(kCylinder, 0.5);
  const Loaded other(kTwoMaterials, 0.3);
  (void)can.generate(0.2);
  EXPECT_EQ(to_bytes(can.generate(0.5)), to_bytes(can.mesh));
}

TEST(CsgCoarseMesh, GetsFinerWithTheSize)
{
  const Loaded cube(kCube, 0.5);
  EXPECT_GT(cube.generate(0.25).num_tets(), 2 * cube.mesh.num_tets());
}

TEST(CsgCoarseMesh, GetsFinerWithCurvature)
{
  const Loaded ball(kSphere, 10.0);
  EXPECT_GT(ball.generate(10.0, 4.0).num_tets(), 2 * ball.mesh.num_tets());
}

TEST(CsgCoarseMesh, KeepsTheFaceBetweenTwoMaterialsOnce)
{
  const Loaded two(kTwoMaterials, 0.5);
  EXPECT_EQ(two.mesh.material_names, (std::vector<std::string>{"iron", "right"}));
  for (LocalIndex t = 0; t < two.mesh.num_tets(); ++t) {
    double x = 0.0;
    for (const LocalIndex v : two.mesh.tet(t)) x += 0.25 * two.mesh.position(v)[0];
    EXPECT_EQ(two.mesh.tet_material[static_cast<std::size_t>(t)], x < 0.5 ? 1 : 2);
  }
  EXPECT_NEAR(testing::volume_of(two.mesh), 1.0, 1e-12);
}

TEST(CsgCoarseMesh, TakesNamesFromTheFile)
{
  const Loaded can(kCylinder, 0.5);
  EXPECT_EQ(can.mesh.material_names, std::vector<std::string>{"steel"});
  const auto& names = can.mesh.patch_names;
  EXPECT_EQ(std::count(names.begin(), names.end(), "side"), 1);
  EXPECT_EQ(std::count_if(names.begin(), names.end(),
                          [](const std::string& name) { return name.starts_with("patch_"); }),
            2);
}

TEST(CsgProjection, PutsPointsOnTheSphere)
{
  const Loaded ball(kSphere, 1.0);
  expect_on_formula(ball, "hull", [](const Vec3& p) { return norm(p - Vec3{1, 2, 3}) - 2.0; });
}

TEST(CsgProjection, PutsPointsOnTheCylinder)
{
  const Loaded can(kCylinder, 0.5);
  expect_on_formula(can, "side", [](const Vec3& p) { return std::hypot(p[0], p[1]) - 0.5; });
}

TEST(CsgProjection, PutsPointsOnTheTorus)
{
  const Loaded ring(kTorus, 1.0);
  expect_on_formula(ring, "skin", [](const Vec3& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 2.0, p[2]) - 1.0;
  });
}

TEST(CsgProjection, PutsPointsOnTheCone)
{
  const Loaded tip(kCone, 1.0);
  expect_on_formula(tip, "mantle", [](const Vec3& p) {
    const double slope = 0.25;  // The radius falls from 2 to 1 over a height of 4.
    return (std::hypot(p[0], p[1]) - (2.0 - slope * p[2])) / std::sqrt(1.0 + slope * slope);
  });
}

TEST(CsgProjection, PutsRimPointsOnTheCircle)
{
  const Loaded can(kCylinder, 0.5);
  const double tolerance = 1e-8 * can.model->box_diagonal();
  ASSERT_GT(can.mesh.num_segments(), 0);
  for (LocalIndex s = 0; s < can.mesh.num_segments(); ++s) {
    const auto at = 2 * static_cast<std::size_t>(s);
    const Vec3 near = midpoint(can.mesh.position(can.mesh.segment_vertices[at]),
                               can.mesh.position(can.mesh.segment_vertices[at + 1]));
    const LocalIndex curve = can.mesh.segment_curve[static_cast<std::size_t>(s)];
    const Vec3 found = can.model->project_to_curve(curve, near, 0.0).xyz;
    EXPECT_NEAR(std::hypot(found[0], found[1]), 0.5, tolerance);
    EXPECT_NEAR(found[2], near[2] < 1.0 ? 0.0 : 2.0, tolerance);
  }
}

TEST(CsgProjection, LeavesCoarseVerticesWhereTheyAre)
{
  const Loaded ring(kTorus, 1.0);
  ASSERT_GT(ring.mesh.num_faces(), 0);
  for (LocalIndex f = 0; f < ring.mesh.num_faces(); ++f) {
    const Vec3 vertex =
        ring.mesh.position(ring.mesh.face_vertices[3 * static_cast<std::size_t>(f)]);
    const Vec3 found = ring.model->project_to_surface(ring.surface_of(f), vertex, {}).xyz;
    EXPECT_LE(norm(found - vertex), 1e-8 * ring.model->box_diagonal());
  }
}

// The same points in two orders give the same bits: what was asked before does not count.
TEST(CsgProjection, DoesNotDependOnTheOrderOfCalls)
{
  for (const char* text : {kSphere, kTorus, kCone, kExtrusion}) {
    const Loaded loaded(text, 1.0);
    std::vector<std::pair<LocalIndex, Vec3>> asked;
    for (LocalIndex f = 0; f < loaded.mesh.num_faces(); ++f) {
      for (const Vec3& p : loaded.points_near(f)) asked.emplace_back(loaded.surface_of(f), p);
    }
    const auto project = [&](std::size_t i) {
      return loaded.model->project_to_surface(asked[i].first, asked[i].second, {}).xyz;
    };
    ASSERT_FALSE(asked.empty()) << text;
    std::vector<Vec3> forward(asked.size());
    std::vector<Vec3> backward(asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) forward[i] = project(i);
    for (std::size_t i = asked.size(); i-- > 0;) backward[i] = project(i);
    EXPECT_EQ(forward, backward) << text;
  }
}

TEST(CsgProjection, RefusesNumbersThatDoNotExist)
{
  const Loaded cube(kCube, 0.5);
  EXPECT_THROW((void)cube.model->project_to_surface(99, {0, 0, 0}, {}), GeometryError);
  EXPECT_THROW((void)cube.model->project_to_curve(-1, {0, 0, 0}, 0.0), GeometryError);
}

TEST(CsgModel, BoxIsThatOfTheSolid)
{
  EXPECT_NEAR(Loaded(kCube, 0.5).model->box_diagonal(), std::sqrt(3.0), 0.02 * std::sqrt(3.0));
  EXPECT_NEAR(Loaded(kSphere, 1.0).model->box_diagonal(), 4.0 * std::sqrt(3.0),
              0.02 * 4.0 * std::sqrt(3.0));
}

}  // namespace
}  // namespace tessera
