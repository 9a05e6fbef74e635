// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "support/meshes.hpp"
#include "support/stl_models.hpp"
#include "support/temporary_file.hpp"

#include "netgen/loaders.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera::netgen {
namespace {

using testing::cube_soup;
using testing::joined;
using testing::sphere_soup;

const std::filesystem::path kOwnModels = TESSERA_OWN_MODELS;

model::ModelSource import(const model::TriangleSoup& soup)
{
  const testing::TemporaryFile file("model.stl", testing::ascii_stl(soup));
  return import_stl(file.path(), {});
}

std::unique_ptr<geometry::LoadedModel> load(const model::TriangleSoup& soup)
{
  return load_stl(import(soup));
}

mesh::CoarseMesh mesh_of(const geometry::LoadedModel& model, double max_size)
{
  surface::CoarseOptions options;
  options.max_size = max_size;
  return ModelMesher(model).generate(options);
}

double distance_to_surface(const geometry::LoadedModel& model, LocalIndex surface, const Vec3& p)
{
  return norm(model.project_to_surface(surface, p, {}).xyz - p);
}

double distance_to_curve(const geometry::LoadedModel& model, LocalIndex curve, const Vec3& p)
{
  return norm(model.project_to_curve(curve, p, 0.0).xyz - p);
}

void expect_on_model(const geometry::LoadedModel& model, const mesh::CoarseMesh& mesh)
{
  EXPECT_NO_THROW(mesh::validate(mesh));
  for (std::size_t i = 0; i < mesh.face_vertices.size(); ++i) {
    const auto patch = static_cast<std::size_t>(mesh.face_patch[i / 3]);
    const LocalIndex surface = mesh.patch_surface[patch];
    EXPECT_LE(distance_to_surface(model, surface, mesh.position(mesh.face_vertices[i])),
              model.surface_tolerance(surface));
  }
  for (std::size_t i = 0; i < mesh.segment_vertices.size(); ++i) {
    const LocalIndex curve = mesh.segment_curve[i / 2];
    EXPECT_LE(distance_to_curve(model, curve, mesh.position(mesh.segment_vertices[i])),
              model.curve_tolerance(curve));
  }
}

using Edge = std::pair<LocalIndex, LocalIndex>;

std::set<Edge> segments_of(const mesh::CoarseMesh& mesh)
{
  std::set<Edge> edges;
  for (std::size_t i = 0; i < mesh.segment_vertices.size(); i += 2) {
    edges.insert(std::minmax({mesh.segment_vertices[i], mesh.segment_vertices[i + 1]}));
  }
  return edges;
}

// Edges whose two faces lie on different patches.
std::set<Edge> edges_between_patches(const mesh::CoarseMesh& mesh)
{
  std::map<Edge, std::set<LocalIndex>> patches;
  for (std::size_t f = 0; f < mesh.face_patch.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex a = mesh.face_vertices[3 * f + c];
      const LocalIndex b = mesh.face_vertices[3 * f + (c + 1) % 3];
      patches[std::minmax({a, b})].insert(mesh.face_patch[f]);
    }
  }
  std::set<Edge> edges;
  for (const auto& [edge, of_edge] : patches) {
    if (of_edge.size() > 1) edges.insert(edge);
  }
  return edges;
}

TEST(StlModel, ImportKeepsTheFilesRepairsAndFeatureAngle)
{
  model::TriangleSoup soup = cube_soup();
  testing::turn_triangle(soup, 3);
  const testing::TemporaryFile file("cube.stl", testing::binary_stl(soup));
  const model::ModelSource source = import_stl(file.path(), {.feature_angle_deg = 100.0});
  EXPECT_EQ(source.format, model::Format::stl);
  EXPECT_EQ(source.repairs.size(), 1U);
  // With 100 degrees the cube is one patch: the point nearest to one above the top is on the top.
  const auto model = load_stl(source);
  EXPECT_EQ(model->project_to_surface(0, {0.5, 0.5, 3.0}, {}).xyz, (Vec3{0.5, 0.5, 1.0}));
  EXPECT_DOUBLE_EQ(model->box_diagonal(), std::sqrt(3.0));
}

TEST(StlModel, DamagedSourceIsRefused)
{
  model::ModelSource source = import(cube_soup());
  source.content.resize(source.content.size() / 2);
  EXPECT_THROW((void)load_stl(source), InputError);
}

TEST(StlModel, ProjectionIsPure)
{
  const auto model = load(sphere_soup(3));
  const Vec3 p{0.3, 0.2, 0.7};
  const Vec3 first = model->project_to_surface(0, p, {}).xyz;
  (void)model->project_to_surface(0, {-1.0, 2.0, 0.3}, {});
  (void)mesh_of(*model, 1.0);
  EXPECT_EQ(model->project_to_surface(0, p, {}).xyz, first);
  EXPECT_EQ(load(sphere_soup(3))->project_to_surface(0, p, {}).xyz, first);
  EXPECT_THROW((void)model->project_to_surface(0, {std::nan(""), 0.0, 0.0}, {}), GeometryError);
}

TEST(StlModel, CubeIsMeshedWithSixPatchesAndTwelveCurves)
{
  const auto model = load(cube_soup());
  const mesh::CoarseMesh mesh = mesh_of(*model, 0.4);
  expect_on_model(*model, mesh);
  EXPECT_EQ(mesh.num_patches(), 6);
  EXPECT_EQ(std::set(mesh.segment_curve.begin(), mesh.segment_curve.end()).size(), 12U);
  EXPECT_NEAR(testing::volume_of(mesh), 1.0, 1e-12);
  EXPECT_EQ(segments_of(mesh), edges_between_patches(mesh));
}

TEST(StlModel, SphereWithoutFeaturesIsMeshedWithoutSegments)
{
  const auto model = load(sphere_soup(4));
  const mesh::CoarseMesh mesh = mesh_of(*model, 0.5);
  expect_on_model(*model, mesh);
  EXPECT_EQ(mesh.num_patches(), 1);
  EXPECT_EQ(mesh.num_segments(), 0);
  EXPECT_NEAR(testing::volume_of(mesh), 4.0 / 3.0 * std::numbers::pi, 0.5);
}

// NETGEN's own rule would make an edge of every edge above 30 degrees, and of no other.
TEST(StlModel, FeatureAngleOfTheModelDecidesNotNetgens)
{
  const testing::TemporaryFile blunt("blunt.stl", testing::ascii_stl(sphere_soup(2)));
  const auto faceted = load_stl(import_stl(blunt.path(), {.feature_angle_deg = 1.0}));
  const mesh::CoarseMesh facets = mesh_of(*faceted, 0.5);
  expect_on_model(*faceted, facets);
  EXPECT_EQ(facets.num_patches(), 128);
  EXPECT_EQ(segments_of(facets), edges_between_patches(facets));

  const testing::TemporaryFile sharp("sharp.stl", testing::ascii_stl(sphere_soup(1)));
  const auto rounded = load_stl(import_stl(sharp.path(), {.feature_angle_deg = 80.0}));
  const mesh::CoarseMesh ball = mesh_of(*rounded, 0.5);
  expect_on_model(*rounded, ball);
  EXPECT_EQ(ball.num_patches(), 1);
  EXPECT_EQ(ball.num_segments(), 0);
}

TEST(StlModel, SizeOfTheModelDoesNotMatter)
{
  const mesh::CoarseMesh unit = mesh_of(*load(cube_soup()), 0.4);
  for (const double size : {0x1p-20, 0x1p20}) {
    const auto model = load(cube_soup({0.0, 0.0, 0.0}, size));
    mesh::CoarseMesh mesh = mesh_of(*model, 0.4 * size);
    EXPECT_EQ(mesh.tet_vertices, unit.tet_vertices);
    for (double& x : mesh.vertex_xyz) x /= size;
    EXPECT_EQ(mesh.vertex_xyz, unit.vertex_xyz);
  }
}

TEST(StlModel, BodiesOfTwoSolidsBecomeTwoMaterials)
{
  model::TriangleSoup both = joined(cube_soup(), sphere_soup(3));
  both.solid_names = {"box", "ball"};
  for (std::size_t i = 9UL * 12; i < both.corner_xyz.size(); i += 3) both.corner_xyz[i] += 4.0;
  const auto model = load(both);
  const mesh::CoarseMesh mesh = mesh_of(*model, 0.5);
  expect_on_model(*model, mesh);
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"box", "ball"}));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const bool in_ball = mesh.position(mesh.tet(t)[0])[0] > 2.0;
    EXPECT_EQ(mesh.tet_material[static_cast<std::size_t>(t)], in_ball ? 2 : 1);
  }
}

TEST(StlModel, CavityStaysEmpty)
{
  const auto model = load(joined(cube_soup({-1.0, -1.0, -1.0}, 3.0), cube_soup()));
  const mesh::CoarseMesh mesh = mesh_of(*model, 1.0);
  expect_on_model(*model, mesh);
  EXPECT_NEAR(testing::volume_of(mesh), 26.0, 1e-10);
}

// A ball with a ball-shaped hole that leaves a wall of 0.03 at one side.
model::TriangleSoup thin_walled_ball()
{
  model::TriangleSoup hole = sphere_soup(5);
  for (double& x : hole.corner_xyz) x *= 0.6;
  for (std::size_t i = 0; i < hole.corner_xyz.size(); i += 3) hole.corner_xyz[i] += 0.37;
  return joined(sphere_soup(5), hole);
}

surface::CoarseOptions rough_remesh()
{
  surface::CoarseOptions options;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  options.max_size = 0.5;
  options.curvature = 0.5;
  return options;
}

TEST(StlModel, RemeshedWallThinnerThanItsTrianglesIsRefinedUntilItIsSound)
{
  const auto model = load(thin_walled_ball());
  const mesh::CoarseMesh mesh = ModelMesher(*model).generate(rough_remesh());
  expect_on_model(*model, mesh);
  const double exact = 4.0 / 3.0 * std::numbers::pi * (1.0 - std::pow(0.6, 3));
  EXPECT_LT(testing::volume_of(mesh), 1.05 * exact) << "chords make the hole smaller, too";
  EXPECT_GT(testing::volume_of(mesh), 0.75 * exact) << "chords of 0.6 in a ball of radius 1";
}

TEST(StlModel, RemeshedBodiesThatOverlapAreRefusedWithTheirFacesAndThePlace)
{
  model::TriangleSoup both = joined(cube_soup(), cube_soup({0.6, 0.7, 0.8}, 1.0));
  both.solid_names = {"left", "right"};
  try {
    (void)ModelMesher(*load(both)).generate(rough_remesh());
    FAIL() << "bodies that overlap were meshed";
  } catch (const MeshError& error) {
    EXPECT_TRUE(std::string(error.what()).find("the surface cuts itself at") != std::string::npos)
        << error.what();
  }
}

// Both in one solid.
model::TriangleSoup in_one_solid(const model::TriangleSoup& a, const model::TriangleSoup& b)
{
  model::TriangleSoup both = joined(a, b);
  both.triangle_solid.assign(both.triangle_solid.size(), 0);
  both.solid_names = {""};
  return both;
}

void expect_one_body(const model::TriangleSoup& soup, double volume)
{
  const model::ModelSource source = import(soup);
  ASSERT_FALSE(source.repairs.empty());
  EXPECT_NE(source.repairs.back().find("joined"), std::string::npos) << source.repairs.back();
  const auto model = load_stl(source);
  const mesh::CoarseMesh mesh = mesh_of(*model, 0.5);
  expect_on_model(*model, mesh);
  EXPECT_NEAR(testing::volume_of(mesh), volume, 1e-5);
}

TEST(StlModel, BodiesThatLieOnEachOtherAreOne)
{
  for (const double gap : {-3e-7, 0.0, 3e-7}) {  // Noise.
    const auto small = cube_soup({0.2, 0.3, 1.0 + gap}, 0.5);
    expect_one_body(in_one_solid(cube_soup(), small), 1.125);
    expect_one_body(in_one_solid(small, cube_soup()), 1.125);
  }
}

TEST(StlModel, BodyOnAnotherThatIsInsideOutInTheFileIsMaterialAsWell)
{
  model::TriangleSoup small = cube_soup({0.2, 0.3, 1.0}, 0.5);
  for (LocalIndex t = 0; t < small.num_triangles(); ++t) testing::turn_triangle(small, t);
  expect_one_body(in_one_solid(cube_soup(), small), 1.125);

  model::TriangleSoup right = cube_soup({0.5, 0.0, 0.0});
  for (LocalIndex t = 0; t < right.num_triangles(); ++t) testing::turn_triangle(right, t);
  expect_one_body(in_one_solid(cube_soup(), right), 1.5);
}

TEST(StlModel, BodiesWithCommonPlanesThatOverlapAreOne)
{
  expect_one_body(in_one_solid(cube_soup(), cube_soup({0.5, 0.0, 0.0})), 1.5);
}

TEST(StlModel, CavityThatReachesToASideIsOpenThere)
{
  model::TriangleSoup cavity = cube_soup({0.2, 0.3, 0.5}, 0.5);
  for (LocalIndex t = 0; t < cavity.num_triangles(); ++t) testing::turn_triangle(cavity, t);
  expect_one_body(in_one_solid(cube_soup(), cavity), 0.875);
}

TEST(StlModel, BodiesThatLieOnEachOtherStayTwoIfTheFileNamesThem)
{
  model::TriangleSoup both = joined(cube_soup(), cube_soup({0.2, 0.3, 1.0}, 0.5));
  both.solid_names = {"lower", "upper"};
  EXPECT_EQ(load(both)->describe(surface::SurfaceMesher::netgen).solids.size(), 2U);
}

TEST(StlModel, BodiesThatLieOnEachOtherStayAsTheyAreIfTheFileNamesTheirSides)
{
  model::TriangleSoup both = in_one_solid(cube_soup(), cube_soup({0.2, 0.3, 1.0}, 0.5));
  both.triangle_solid[0] = both.triangle_solid[1] = 1;  // A side of the larger one.
  both.solid_names = {"wall", "lid"};
  const model::ModelSource source = import(both);
  EXPECT_TRUE(std::ranges::none_of(source.repairs, [](const std::string& line) {
    return line.find("joined") != std::string::npos;
  }));
}

TEST(StlModel, PlainReaderJoinsNothing)
{
  const testing::TemporaryFile file(
      "model.stl", testing::ascii_stl(in_one_solid(cube_soup(), cube_soup({0.2, 0.3, 1.0}, 0.5))));
  EXPECT_TRUE(import_stl(file.path(), {}, model::StepReader::plain).repairs.empty());
}

TEST(StlModel, OwnModelsGiveGoodCoarseMeshes)
{
  for (const auto* name : {"plate_with_hole.stl", "bracket.stl"}) {
    const model::ModelSource source = import_stl(kOwnModels / name, {});
    EXPECT_TRUE(source.repairs.empty()) << name;
    const auto model = load_stl(source);
    const mesh::CoarseMesh mesh = mesh_of(*model, 20.0);
    expect_on_model(*model, mesh);
    EXPECT_EQ(segments_of(mesh), edges_between_patches(mesh)) << name;
  }
}

}  // namespace
}  // namespace tessera::netgen
