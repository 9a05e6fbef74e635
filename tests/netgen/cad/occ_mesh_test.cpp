// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>
#include <set>
#include <tuple>

#include <BRepTools.hxx>
#include <gtest/gtest.h>

#include "tessera/surface/mend_folds.hpp"

#include "support/temporary_folder.hpp"

#include "netgen/cad/hard_shapes.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using mesh::CoarseMesh;
using model::SurfaceParameters;
using testing::coarse_mesh_of;
using testing::load_own;

SurfaceParameters corner_uv(const CoarseMesh& mesh, LocalIndex face, int corner)
{
  const auto at = static_cast<std::size_t>(2 * (3 * face + corner));
  return {mesh.face_uv[at], mesh.face_uv[at + 1]};
}

LocalIndex corner_vertex(const CoarseMesh& mesh, LocalIndex face, int corner)
{
  return mesh.face_vertices[static_cast<std::size_t>(3 * face + corner)];
}

LocalIndex surface_of(const CoarseMesh& mesh, LocalIndex face)
{
  const LocalIndex patch = mesh.face_patch[static_cast<std::size_t>(face)];
  return mesh.patch_surface[static_cast<std::size_t>(patch)];
}

double volume_of(const CoarseMesh& mesh, LocalIndex material)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (mesh.tet_material[static_cast<std::size_t>(t)] != material) continue;
    const auto v = mesh.tet(t);
    volume += tet_volume(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]),
                         mesh.position(v[3]));
  }
  return volume;
}

struct OwnModel {
  const char* file;
  double max_size;
};

void PrintTo(const OwnModel& model, std::ostream* out) { *out << model.file; }

// Whoever makes the surface, the mesh keeps the same promises.
class OccMesh : public ::testing::TestWithParam<std::tuple<OwnModel, surface::SurfaceMesher>> {
 protected:
  [[nodiscard]] static CoarseMesh mesh_of(const model::Model& model)
  {
    const auto& [own, mesher] = GetParam();
    return coarse_mesh_of(model, own.max_size, mesher);
  }

  std::unique_ptr<model::Model> model_ = load_own(std::get<0>(GetParam()).file);
  CoarseMesh mesh_ = mesh_of(*model_);
};

TEST_P(OccMesh, IsValidWithParametersOnEveryEntity)
{
  EXPECT_NO_THROW(mesh::validate(mesh_));
  EXPECT_EQ(mesh_.face_uv.size(), 6U * static_cast<std::size_t>(mesh_.num_faces()));
  EXPECT_EQ(mesh_.segment_t.size(), 2U * static_cast<std::size_t>(mesh_.num_segments()));
}

TEST_P(OccMesh, CornersLieOnTheirSurfaceAtTheirParameters)
{
  for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 vertex = mesh_.position(corner_vertex(mesh_, f, c));
      const SurfaceParameters uv = corner_uv(mesh_, f, c);
      const model::SurfacePoint found =
          model_->project_to_surface(surface_of(mesh_, f), vertex, uv);
      EXPECT_LE(norm(found.xyz - vertex), model_->surface_tolerance(surface_of(mesh_, f)));
    }
  }
}

// No side of a triangle may jump a seam or the other way round a pole: its middle in parameters
// must project to a point near its middle in space.
TEST_P(OccMesh, MiddlesOfTriangleSidesProjectNearby)
{
  for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3;
      const SurfaceParameters a = corner_uv(mesh_, f, c);
      const SurfaceParameters b = corner_uv(mesh_, f, d);
      const Vec3 p = mesh_.position(corner_vertex(mesh_, f, c));
      const Vec3 q = mesh_.position(corner_vertex(mesh_, f, d));
      const SurfaceParameters guess{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
      const auto found = model_->project_to_surface(surface_of(mesh_, f), midpoint(p, q), guess);
      EXPECT_LE(norm(found.xyz - midpoint(p, q)), 0.3 * norm(p - q));
      const Vec3 from = model_->project_to_surface(surface_of(mesh_, f), found.xyz, guess).xyz;
      EXPECT_LE(norm(from - found.xyz), 1e-9 * model_->box_diagonal());
    }
  }
}

TEST_P(OccMesh, SegmentEndsLieOnTheirCurveOnOneBranch)
{
  for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
    const auto at = static_cast<std::size_t>(s);
    const LocalIndex curve = mesh_.segment_curve[at];
    const Vec3 p = mesh_.position(mesh_.segment_vertices[2 * at]);
    const Vec3 q = mesh_.position(mesh_.segment_vertices[2 * at + 1]);
    const double t0 = mesh_.segment_t[2 * at];
    const double t1 = mesh_.segment_t[2 * at + 1];
    EXPECT_LE(norm(model_->project_to_curve(curve, p, t0).xyz - p), model_->curve_tolerance(curve));
    EXPECT_LE(norm(model_->project_to_curve(curve, q, t1).xyz - q), model_->curve_tolerance(curve));
    const model::CurvePoint middle =
        model_->project_to_curve(curve, midpoint(p, q), 0.5 * (t0 + t1));
    EXPECT_LE(norm(middle.xyz - midpoint(p, q)), 0.3 * norm(p - q));
    EXPECT_GT((middle.t - t0) * (t1 - middle.t), 0.0) << "the middle lies between the ends";
  }
}

TEST_P(OccMesh, IsTheSameForASecondModelOfTheSameSource)
{
  const auto again = load_own(std::get<0>(GetParam()).file);
  EXPECT_EQ(to_bytes(mesh_of(*again)), to_bytes(mesh_));
  EXPECT_EQ(to_bytes(mesh_of(*model_)), to_bytes(mesh_));
}

INSTANTIATE_TEST_SUITE_P(
    OwnModels, OccMesh,
    ::testing::Combine(
        ::testing::Values(OwnModel{"sphere.step", 6.0}, OwnModel{"cylinder.step", 6.0},
                          OwnModel{"torus.step", 6.0}, OwnModel{"bracket.step", 10.0},
                          OwnModel{"two_blocks.step", 5.0}, OwnModel{"frustum.iges", 1.0}),
        ::testing::Values(surface::SurfaceMesher::netgen, surface::SurfaceMesher::remesh)));

// Towards its tip a cone bends more than any tessellation shows, so a remeshed one is wider there.
INSTANTIATE_TEST_SUITE_P(Cone, OccMesh,
                         ::testing::Combine(::testing::Values(OwnModel{"cone.brep", 5.0}),
                                            ::testing::Values(surface::SurfaceMesher::netgen)));

TEST(OccCoarseMesh, RemeshedHasTheVolumesAndNamesOfTheSolids)
{
  const CoarseMesh mesh =
      coarse_mesh_of(*load_own("two_blocks.step"), 5.0, surface::SurfaceMesher::remesh);
  const std::map<std::string, double> expected{{"steel", 1000.0}, {"copper", 288.0}};
  ASSERT_EQ(mesh.num_materials(), 2);
  for (LocalIndex m = 1; m <= 2; ++m) {
    EXPECT_NEAR(volume_of(mesh, m), expected.at(mesh.material_names[at(m - 1)]), 1e-6);
  }
}

TEST(OccCoarseMesh, TakesPatchNamesFromTheFile)
{
  const CoarseMesh mesh = coarse_mesh_of(*load_own("cylinder.step"), 6.0);
  EXPECT_EQ(std::set<std::string>(mesh.patch_names.begin(), mesh.patch_names.end()),
            (std::set<std::string>{"side", "top", "bottom"}));
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto patch = static_cast<std::size_t>(mesh.face_patch[static_cast<std::size_t>(f)]);
    for (int c = 0; c < 3; ++c) {
      const Vec3 p = mesh.position(corner_vertex(mesh, f, c));
      const std::string& name = mesh.patch_names[patch];
      const double height = name == "top" ? 20.0 : name == "bottom" ? 0.0 : p[2];
      EXPECT_NEAR(p[2], height, 1e-9);
    }
  }
}

TEST(OccCoarseMesh, TakesMaterialNamesFromTheSolids)
{
  const CoarseMesh mesh = coarse_mesh_of(*load_own("two_blocks.step"), 5.0);
  ASSERT_EQ(mesh.num_materials(), 2);
  const std::map<std::string, double> expected{{"steel", 1000.0}, {"copper", 288.0}};
  for (LocalIndex m = 1; m <= 2; ++m) {
    const std::string& name = mesh.material_names[static_cast<std::size_t>(m - 1)];
    EXPECT_NEAR(volume_of(mesh, m), expected.at(name), 1e-6);
  }
}

TEST(OccCoarseMesh, SolidsThatTouchShareTheVerticesBetweenThem)
{
  const CoarseMesh mesh = coarse_mesh_of(*load_own("two_blocks.step"), 5.0);
  std::set<Vec3> places;
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) places.insert(mesh.position(v));
  EXPECT_EQ(places.size(), static_cast<std::size_t>(mesh.num_vertices())) << "no doubled vertex";

  std::set<LocalIndex> of_steel;
  std::set<LocalIndex> of_copper;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = mesh.tet(t);
    auto& side = mesh.tet_material[static_cast<std::size_t>(t)] == 1 ? of_steel : of_copper;
    side.insert(tet.begin(), tet.end());
  }
  int num_shared = 0;
  for (const LocalIndex v : of_steel) num_shared += of_copper.contains(v) ? 1 : 0;
  EXPECT_GE(num_shared, 4) << "at least the corners of the common square";
}

double smallest_face_angle_deg(const CoarseMesh& mesh)
{
  double least = std::numbers::pi;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 tip = mesh.position(corner_vertex(mesh, f, c));
      const Vec3 u = mesh.position(corner_vertex(mesh, f, (c + 1) % 3)) - tip;
      const Vec3 v = mesh.position(corner_vertex(mesh, f, (c + 2) % 3)) - tip;
      least = std::min(least, std::atan2(norm(cross(u, v)), dot(u, v)));
    }
  }
  return least * 180.0 / std::numbers::pi;
}

// The shorter the edges from the tip, the sharper the triangle there.
TEST(OccCoarseMesh, HasNoShortEdgesWhereCurvesTouch)
{
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "cusp.brep";
  ASSERT_TRUE(BRepTools::Write(testing::cusp(), file.c_str()));
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  const CoarseMesh mesh = coarse_mesh_of(*model, 0.2);
  mesh::validate(mesh);
  EXPECT_GT(smallest_face_angle_deg(mesh), 4.0);
}

// A ledge of 0.001 along a block of 4.
TEST(OccSurface, HasNoMoreThanItsShareAtALongNarrowLedge)
{
  const auto model = load_own("ledge.brep");
  surface::CoarseOptions options;
  options.max_size = 1.0;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  const auto surface = netgen::make_coarse_mesher(*model)->mesh_surface(options, {});
  EXPECT_GT(surface.mesh.num_faces(), 500);
  EXPECT_LT(surface.mesh.num_faces(), 3'000);
}

TEST(OccSurface, HasNoMoreThanItsShareAtSmallRoundedEdges)
{
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "rounded.brep";
  ASSERT_TRUE(BRepTools::Write(testing::rounded_block(0.05), file.c_str()));
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  surface::CoarseOptions options;
  options.max_size = 1.0;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  const auto surface = netgen::make_coarse_mesher(*model)->mesh_surface(options, {});
  EXPECT_GT(surface.mesh.num_faces(), 2'000);
  EXPECT_LT(surface.mesh.num_faces(), 30'000);
}

// Better shapes alone would leave 11 folds along the ledge that cannot be mended.
TEST(OccSurface, DoesNotFoldAtANarrowLedgeForBetterShapes)
{
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "shaft.brep";
  ASSERT_TRUE(BRepTools::Write(testing::shoulder(0.05), file.c_str()));
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  surface::CoarseOptions options;
  options.max_size = 5.0;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  auto surface = netgen::make_coarse_mesher(*model)->mesh_surface(options, {});
  EXPECT_EQ(surface::mend_folds(surface, *model).num_before, 0);
}

}  // namespace
}  // namespace tessera
