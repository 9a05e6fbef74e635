// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/temporary_file.hpp"

namespace tessera {
namespace {

// A cone up to its apex, radius 1 and height 1.5, along (1, 2, 2) from (0.3, -0.2, 0.1).
constexpr const char* kTip =
    "solid tip = cone (0.3, -0.2, 0.1; 1; 0.8, 0.8, 1.1; 0) -bcname=mantle;\n"
    "solid ground = plane (0.3, -0.2, 0.1; -1, -2, -2) -bcname=foot;\n"
    "solid cone1 = tip and ground and plane (0.8, 0.8, 1.1; 1, 2, 2);\n";
constexpr double kTipVolume = std::numbers::pi * 1.5 / 3.0;

model::ModelSource source_of(const std::string& solids)
{
  const testing::TemporaryFile file("model.geo", "algebraic3d\n" + solids);
  return netgen::import_model(file.path(), {});
}

double volume_of(const std::string& solids)
{
  const auto model = netgen::load_model(source_of(solids));
  double volume = 0.0;
  for (const auto& solid : netgen::describe_model(*model).solids) volume += solid.volume;
  return volume;
}

double volume_of(const mesh::CoarseMesh& mesh, LocalIndex material)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (mesh.tet_material[at(t)] != material) continue;
    const auto tet = mesh.tet(t);
    volume += tet_volume(mesh.position(tet[0]), mesh.position(tet[1]), mesh.position(tet[2]),
                         mesh.position(tet[3]));
  }
  return volume;
}

TEST(CsgApex, IsMeshed)
{
  const model::ModelSource source = source_of(std::string(kTip) + "tlo cone1 -material=steel;\n");
  EXPECT_EQ(source.repairs.size(), 1U);
  const auto model = netgen::load_model(source);
  surface::CoarseOptions options;
  options.max_size = 0.3;
  const mesh::CoarseMesh mesh = netgen::make_coarse_mesher(*model)->generate(options);
  EXPECT_NEAR(volume_of(mesh, 1), kTipVolume, 0.05 * kTipVolume);
  EXPECT_EQ(mesh.material_names, std::vector<std::string>{"steel"});
  EXPECT_EQ(std::set(mesh.patch_names.begin(), mesh.patch_names.end()),
            (std::set<std::string>{"foot", "mantle"}));
}

TEST(CsgApex, KeepsTheOperationsOfTheFile)
{
  const std::string tip = kTip;
  const double cube = 64.0;
  const std::string box = "solid cube = orthobrick (-2, -2, -2; 2, 2, 2);\n";
  EXPECT_NEAR(volume_of(tip + "tlo cone1;\n"), kTipVolume, 1e-6);
  EXPECT_NEAR(volume_of(tip + box + "solid hole = cube and not cone1;\ntlo hole;\n"),
              cube - kTipVolume, 1e-6 * cube);
  // All but the cone, and all but the cube: what they have in common is outside of both.
  EXPECT_NEAR(
      volume_of(tip
                + "solid far = sphere (5, 0, 0; 1);\nsolid outside = not cone1 and not far;\n"
                  "solid both = not outside;\ntlo both;\n"),
      kTipVolume + 4.0 / 3.0 * std::numbers::pi, 1e-5);
  EXPECT_NEAR(volume_of(tip
                        + "solid can = cylinder (5, 0, 0; 5, 0, 1; 0.5)\n"
                          "  and plane (5, 0, 0; 0, 0, -1) and plane (5, 0, 2; 0, 0, 1);\n"
                          "solid ring = torus (-5, 0, 0; 0, 0, 1; 2; 0.5);\n"
                          "solid all = cone1 or can or ring;\ntlo all;\n"),
              kTipVolume + 0.5 * std::numbers::pi + std::numbers::pi * std::numbers::pi, 1e-5);
}

TEST(CsgApex, IsNoMatterWhereItIsCutOff)
{
  const auto model = netgen::load_model(
      source_of("solid tip = cone (0, 0, 0; 1; 0, 0, 2; 0)\n"
                "  and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1);\ntlo tip;\n"));
  EXPECT_FALSE(model->has_parameters());  // NETGEN's CSG has it.
}

// NETGEN has found no end of points of other surfaces, as the cone is given by its apex.
TEST(CsgApex, IsNoMatterOutsideTheSolid)
{
  const auto model = netgen::load_model(
      source_of("solid ball = sphere (-0.25, 0, -0.25; 0.5);\n"
                "solid tip = cone (0.25, 0.75, 0; 0.75; 0.25, 1.75, 0; 0)\n"
                "  and plane (0.25, 0.75, 0; 0, -1, 0) and plane (0.25, 1.75, 0; 0, 1, 0);\n"
                "solid stump = cone (0, -0.25, 0.25; 0.5; 0, 1.25, 0.25; 0.21)\n"
                "  and plane (0, -0.25, 0.25; 0, -1, 0) and plane (0, 1.25, 0.25; 0, 1, 0);\n"
                "solid all = (ball or tip) and stump;\ntlo all;\n"));
  EXPECT_FALSE(model->has_parameters());
  surface::CoarseOptions options;
  options.max_size = 0.3;
  EXPECT_GT(netgen::make_coarse_mesher(*model)->generate(options).num_tets(), 0);
}

// A ball and a rod of size 1 that overlap by 1e-4: NETGEN's search does not find what they share.
constexpr const char* kSpeck =
    "solid ball = sphere (0, 0, 0; 1) -bcname=round;\n"
    "solid rod = cylinder (0.99992, -1.49994, -0.8; 1.71992, -0.53994, 0.8; 0.7)\n"
    "  and plane (0.99992, -1.49994, -0.8; -0.36, -0.48, -0.8)\n"
    "  and plane (1.71992, -0.53994, 0.8; 0.36, 0.48, 0.8);\n"
    "solid speck = ball and rod;\n";

TEST(CsgSpeck, IsFoundByOpenCascade)
{
  const double overlap = 1e-4;
  const double expected = std::numbers::pi * overlap * overlap / std::sqrt(1.0 + 1.0 / 0.7);
  const model::ModelSource source = source_of(std::string(kSpeck) + "tlo speck -material=dust;\n");
  EXPECT_EQ(source.repairs.size(), 1U);
  const auto model = netgen::load_model(source);
  const auto described = netgen::describe_model(*model);
  ASSERT_EQ(described.solids.size(), 1U);
  EXPECT_EQ(described.solids[0].name, "dust");
  EXPECT_NEAR(described.solids[0].volume, expected, 1e-3 * expected);
}

TEST(CsgSpeck, IsNotWhatIsEmpty)
{
  const std::string far = "solid far = sphere (5, 0, 0; 1);\nsolid both = ball and far;\n";
  EXPECT_THROW((void)source_of(kSpeck + far + "tlo both;\n"), GeometryError);
}

// NETGEN sees the block, but not the brick beside it, and would mesh the block alone.
TEST(CsgSpeck, IsFoundBesideASolid)
{
  const model::ModelSource source = source_of(
      "solid block = orthobrick (0, 0, 0; 1, 1, 1);\n"
      "solid brick = orthobrick (1.5, 0.5, 0.5; 1.501, 0.501, 0.501);\n"
      "tlo block;\ntlo brick;\n");
  EXPECT_EQ(source.repairs.size(), 1U);
  const auto described = netgen::describe_model(*netgen::load_model(source));
  ASSERT_EQ(described.solids.size(), 2U);
  EXPECT_NEAR(described.solids[0].volume, 1.0, 1e-9);
  EXPECT_NEAR(described.solids[1].volume, 1e-9, 1e-12);
}

TEST(CsgSpeck, IsNotWhatIsEmptyBesideASolid)
{
  const model::ModelSource source = source_of(
      "solid block = orthobrick (0, 0, 0; 1, 1, 1);\n"
      "solid none = orthobrick (2, 0, 0; 3, 1, 1) and sphere (5, 0, 0; 1);\n"
      "tlo block;\ntlo none;\n");
  EXPECT_EQ(source.format, model::Format::csg);
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_EQ(source.repairs[0], "solid none holds nothing: left out");
}

// OpenCASCADE cannot tell: an ellipsoid has no counterpart. NETGEN's model is none the worse for
// it.
TEST(CsgSpeck, IsNamedWhereOpenCascadeCannotTell)
{
  const model::ModelSource source = source_of(
      "solid egg = ellipsoid (0, 0, 0; 1, 0, 0; 0, 2, 0; 0, 0, 1);\n"
      "solid brick = orthobrick (9, 9, 9; 9.001, 9.001, 9.001);\n"
      "tlo egg;\ntlo brick;\n");
  EXPECT_EQ(source.format, model::Format::csg);
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_NE(source.repairs[0].find("nothing of solid brick"), std::string::npos);
  EXPECT_NE(source.repairs[0].find("left out"), std::string::npos);
}

// What NETGEN's own mesher cannot do is left to it.
struct Remeshed {
  model::ModelSource source{};
  std::unique_ptr<model::Model> model{};
  mesh::CoarseMesh mesh{};
};

Remeshed remeshed(const std::string& solids, double max_size)
{
  Remeshed made{.source = source_of(solids)};
  made.model = netgen::load_model(made.source);
  surface::CoarseOptions options;
  options.max_size = max_size;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  made.mesh = netgen::make_coarse_mesher(*made.model)->generate(options);
  return made;
}

double largest_distance(const model::Model& model, const mesh::CoarseMesh& mesh)
{
  double largest = 0.0;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex surface = mesh.patch_surface[at(mesh.face_patch[at(f)])];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 corner = mesh.position(mesh.face_vertices[3 * at(f) + c]);
      const Vec3 on_it = model.project_to_surface(surface, corner, {}).xyz;
      largest = std::max(largest, norm(on_it - corner));
    }
  }
  return largest;
}

// Two solids that touch in a disc.
constexpr const char* kPair =
    "solid box = orthobrick (-1, -1, 0; 1, 1, 1) -bcname=case;\n"
    "solid can = cylinder (0, 0, 0; 0, 0, 1; 0.5) -bcname=mantle;\n"
    "solid base = plane (0, 0, 0; 0, 0, -1) -bcname=ground;\n"
    "solid hole = box and not can and base;\nsolid core = can and box and base;\n"
    "tlo hole -material=steel -maxh=0.3;\ntlo core -material=lead;\n";

TEST(CsgRemesh, IsInTheNumbersOfTheFile)
{
  const auto [source, model, mesh] = remeshed(kPair, 0.5);
  EXPECT_FALSE(model->has_parameters());  // It is NETGEN's.
  EXPECT_TRUE(mesh.face_uv.empty());
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"steel", "lead"}));
  const double core = 0.25 * std::numbers::pi;
  // The cylinder has eleven sides.
  EXPECT_NEAR(volume_of(mesh, 1), 4.0 - core, 0.05);
  EXPECT_NEAR(volume_of(mesh, 2), core, 0.05);
  EXPECT_EQ(std::ranges::count(mesh.patch_names, "mantle"), 1);
  EXPECT_LT(largest_distance(*model, mesh), 1e-6);
  EXPECT_GT(mesh.num_segments(), 0);
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {  // Seams are none.
    const Vec3 end = mesh.position(mesh.segment_vertices[2 * at(s)]);
    EXPECT_LT(norm(model->project_to_curve(mesh.segment_curve[at(s)], end, 0.0).xyz - end), 1e-6);
  }
}

double shortest_edge(const mesh::CoarseMesh& mesh)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t corner = 0; corner < mesh.face_vertices.size(); ++corner) {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    shortest = std::min(shortest, norm(mesh.position(mesh.face_vertices[next])
                                       - mesh.position(mesh.face_vertices[corner])));
  }
  return shortest;
}

// OpenCASCADE has seams and poles there, one of them near the circle where the balls meet, and
// triangles that are needles. Edges are to be half a radius long, and six at least go round.
TEST(CsgRemesh, KnowsNoSeamsAndNoPoles)
{
  const auto mesh =
      remeshed(
          "solid left = sphere (0, 0, 0; 1.3);\nsolid right = sphere (1, 0, 0; 1.5);\n"
          "solid both = left or right;\ntlo both;\n",
          1.8)
          .mesh;
  EXPECT_GT(shortest_edge(mesh), 0.3);
  EXPECT_EQ(std::set(mesh.segment_curve.begin(), mesh.segment_curve.end()).size(), 1U);
  const auto ball = remeshed("solid ball = sphere (0, 0, 0; 1);\ntlo ball;\n", 1.0).mesh;
  EXPECT_EQ(ball.num_segments(), 0);
}

// What was two bodies in the file has no edge between them.
TEST(CsgRemesh, HasNoEdgeWithinAPlane)
{
  const auto mesh = remeshed(
                        "solid left = orthobrick (0, 0, 0; 1, 1, 1);\n"
                        "solid right = orthobrick (0.9, 0, 0; 2, 1, 1);\n"
                        "solid both = left or right;\ntlo both;\n",
                        0.5)
                        .mesh;
  EXPECT_EQ(mesh.num_patches(), 6);
  EXPECT_GT(shortest_edge(mesh), 0.25);
  EXPECT_EQ(std::set(mesh.segment_curve.begin(), mesh.segment_curve.end()).size(), 12U);
}

TEST(CsgRemesh, TakesTheSizesOfTheFile)
{
  const auto mesh = remeshed(
                        "solid ball = sphere (0, 0, 0; 1) -maxh=0.15;\nsolid box = orthobrick (-2, "
                        "-2, -2; 2, 2, 2);\n"
                        "solid rest = box and not ball;\ntlo rest;\ntlo ball;\n",
                        1.0)
                        .mesh;
  double longest = 0.0;
  for (std::size_t corner = 0; corner < mesh.face_vertices.size(); corner += 3) {
    const Vec3 a = mesh.position(mesh.face_vertices[corner]);
    const Vec3 b = mesh.position(mesh.face_vertices[corner + 1]);
    if (norm(a) < 1.1 && norm(b) < 1.1) longest = std::max(longest, norm(b - a));
  }
  EXPECT_GT(longest, 0.0);
  EXPECT_LT(longest, 0.3);
}

// Empty: it can.
std::string why_not_remeshed(const std::string& solids)
{
  try {
    (void)remeshed(solids, 0.5);
    return {};
  } catch (const NetgenError& error) {
    return error.what();
  }
}

// A step of 0.005 on a cube of 1.
TEST(CsgRemesh, NamesWhatIsMergedInTheNumbersOfTheFile)
{
  const auto source = source_of(
      "solid cube = orthobrick (0, 0, 0; 1, 1, 1);\n"
      "solid step = orthobrick (0.3, 0.3, 0.9; 0.6, 0.6, 1.005);\n"
      "solid both = cube or step;\ntlo both;\n");
  const auto model = netgen::load_model(source);
  surface::CoarseOptions options;
  options.max_size = 0.4;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  options.defeature = 0.02;
  const auto mesher = netgen::make_coarse_mesher(*model);
  const surface::Defeatured merged = mesher->mesh_surface(options, {}).defeatured;
  ASSERT_EQ(merged.patches.size(), 4U);
  for (const surface::MergedPart& side : merged.patches) {
    EXPECT_NEAR(side.measure, 0.3 * 0.005, 1e-9);
    const Vec3 on_it = model->project_to_surface(side.number, side.centre, {}).xyz;
    EXPECT_LT(norm(on_it - side.centre), 1e-9);
  }
  ASSERT_FALSE(merged.curves.empty());
  for (const surface::MergedPart& edge : merged.curves) {
    const Vec3 on_it = model->project_to_curve(edge.number, edge.centre, 0.0).xyz;
    EXPECT_LT(norm(on_it - edge.centre), 1e-9);
  }
  options.kept.patches = {merged.patches.front().number};
  for (const surface::MergedPart& side : mesher->mesh_surface(options, {}).defeatured.patches)
    EXPECT_NE(side.number, options.kept.patches.front());
}

// Chords that are as long as the case allows would be off by more than the wall is thick.
TEST(CsgRemesh, IsOnTheSurfacesOfAThinShell)
{
  const auto [source, model, mesh] = remeshed(
      "solid shell = sphere (0, 0, 0; 1) and not sphere (0, 0, 0; 0.98)\n"
      "  and orthobrick (-0.3, -0.3, 0; 0.3, 0.3, 2);\ntlo shell -maxh=0.02;\n",
      2.0);
  EXPECT_LT(largest_distance(*model, mesh), 1e-6);
}

TEST(CsgRemesh, IsNotForWhatOnlyNetgenKnows)
{
  const std::string cube =
      "solid p1 = plane (0, 0, 0; -1, 0, 0);\nsolid p2 = plane (1, 1, 1; 1, 0, 0);\n"
      "solid cube = p1 and p2 and plane (0, 0, 0; 0, -1, 0) and plane (1, 1, 1; 0, 1, 0)\n"
      "  and plane (0, 0, 0; 0, 0, -1) and plane (1, 1, 1; 0, 0, 1);\ntlo cube;\n";
  EXPECT_EQ(why_not_remeshed(cube), "");
  EXPECT_NE(why_not_remeshed(cube + "identify periodic p1 p2;\n").find("identifies"),
            std::string::npos);
  EXPECT_NE(
      why_not_remeshed("solid egg = ellipsoid (0, 0, 0; 1, 0, 0; 0, 2, 0; 0, 0, 1);\ntlo egg;\n")
          .find("spheres"),
      std::string::npos);
}

// NETGEN takes the plane for a part of the ball's surface: the point that gives it lies on the
// ball.
TEST(CsgPlane, MayBeGivenByAPointOfAnotherSurface)
{
  const auto [source, model, mesh] = remeshed(
      "solid ball = sphere (0, 0, 0; 0.75);\n"
      "solid cut = ball and plane (0.5, -0.25, -0.5; 0, -1, 0);\ntlo cut;\n",
      0.3);
  const double height = 0.5;  // Of the cap that is cut off.
  const double cap = std::numbers::pi * height * height * (0.75 - height / 3.0);
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.75 * 0.75 * 0.75;
  EXPECT_NEAR(volume_of(mesh, 1), ball - cap, 0.3 * cap);
  EXPECT_EQ(std::set(mesh.patch_surface.begin(), mesh.patch_surface.end()).size(), 2U);
}

double distance_to_vertices(const Vec3& point, const mesh::CoarseMesh& mesh)
{
  double least = std::numeric_limits<double>::infinity();
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    least = std::min(least, norm(mesh.position(v) - point));
  }
  return least;
}

// The rim of a hollow cone touches two sides of its block. NETGEN 6.2.2501 gives the sides a vertex
// there, NETGEN 6.2.1905 does not.
TEST(CsgApex, BodyThatTouchesItselfIsMeshedThereOrToldWithThePlace)
{
  const std::string hollow =
      "solid block = orthobrick (-1, -0.3, -0.6; 1, 1.3, 1.5);\n"
      "solid tip = cone (0, 0, 0; 1; 0, 0, 1.2; 0)\n"
      "  and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1.2; 0, 0, 1);\n"
      "solid hollow = block and not tip;\ntlo hollow;\n";
  const auto model = netgen::load_model(source_of(hollow));
  surface::CoarseOptions options;
  options.max_size = 0.4;
  try {
    const mesh::CoarseMesh mesh = netgen::make_coarse_mesher(*model)->generate(options);
    EXPECT_LT(distance_to_vertices({1.0, 0.0, 0.0}, mesh), 1e-9);
    EXPECT_LT(distance_to_vertices({-1.0, 0.0, 0.0}, mesh), 1e-9);
    const double volume = volume_of(hollow);
    EXPECT_NEAR(volume_of(mesh, 1), volume, 0.02 * volume);
  } catch (const NetgenError& error) {
    EXPECT_NE(std::string(error.what()).find("touches itself at ("), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("1, "), std::string::npos) << error.what();
  }
}

TEST(CsgApex, IsRefusedBesideWhatOpenCascadeDoesNotHave)
{
  try {
    (void)source_of(std::string(kTip) + "solid egg = ellipsoid (5, 0, 0; 1, 0, 0; 0, 1, 0; 0, 0, 2);\n"
                    "solid both = cone1 or egg;\ntlo both;\n");
    ADD_FAILURE() << "not refused";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("spheres"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tessera
