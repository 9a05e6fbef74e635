// SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

#include "cad/heal/overlaps.hpp"
#include "cad/shape.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera::cad {
namespace {

constexpr double kGap = 2e-6;  // More than OpenCASCADE takes for one, and nothing in a mesh.

TopoDS_Shape box(const gp_Pnt& low, const gp_Pnt& high)
{
  return BRepPrimAPI_MakeBox(low, high).Shape();
}

TopoDS_Shape block() { return box({0, 0, 0}, {4, 4, 2}); }

TopoDS_Shape the_solid_of(const TopoDS_Shape& shape) { return parts_of(shape, TopAbs_SOLID).at(0); }

TopoDS_Shape united(const TopoDS_Shape& a, const TopoDS_Shape& b)
{
  return the_solid_of(BRepAlgoAPI_Fuse(a, b).Shape());
}

TopoDS_Shape without(const TopoDS_Shape& a, const TopoDS_Shape& b)
{
  return the_solid_of(BRepAlgoAPI_Cut(a, b).Shape());
}

TopoDS_Shape disc(const gp_Pnt& foot, double radius, double height = 1.0)
{
  return BRepPrimAPI_MakeCylinder(gp_Ax2(foot, gp_Dir(0, 0, 1)), radius, height).Shape();
}

struct Touching {
  const char* name;
  TopoDS_Shape solid;
  int num_faces_without;
};

void PrintTo(const Touching& model, std::ostream* out) { *out << model.name; }

std::vector<Touching> touching_solids()
{
  const TopoDS_Shape boss = united(block(), box({4, 1, 1}, {5, 3, 2 - kGap}));
  return {
      {"AHoleComesToTheRim", boss, 11},
      {"AStripJoinsTwoFaces", united(block(), box({4, 1, 0}, {5, 3, 2 - kGap})), 12},
      {"AHoleComesToTwoSides", united(block(), box({4, 1, kGap}, {5, 3, 2 - kGap})), 12},
      {"AHoleFillsItsFace", united(block(), box({4, kGap, kGap}, {5, 4 - kGap, 2 - kGap})), 10},
      {"ACircleComesToARim", united(disc({0, 0, 0}, 2), disc({0, 0, 1}, 2 - kGap)), 4},
      {"ASlotComesToTheRim", without(block(), box({3, 1, 1}, {5, 3, 2 - kGap})), 11},
      {"ACavityIsBeside", without(boss, box({1, 1, 0.5}, {2, 2, 1.5})), 17},
  };
}

std::string name_of_model(const ::testing::TestParamInfo<Touching>& info)
{
  return info.param.name;
}

class OccOverlaps : public ::testing::TestWithParam<Touching> {};

TEST_P(OccOverlaps, BecomeOneEdgeOfAValidSolid)
{
  const TopoDS_Shape& solid = GetParam().solid;
  CadFile cad{.shape = solid};
  const TopoDS_Shape body = without_overlaps(solid, cad);
  ASSERT_EQ(cad.repairs.size(), 1U);
  EXPECT_NE(cad.repairs[0].find("were made one"), std::string::npos) << cad.repairs[0];
  EXPECT_TRUE(BRepCheck_Analyzer(body).IsValid());
  EXPECT_TRUE(is_closed(body));
  EXPECT_NEAR(volume_of(body), volume_of(solid), 10.0 * kGap);
  EXPECT_EQ(parts_of(body, TopAbs_FACE).size(), at(GetParam().num_faces_without));
  CadFile again{.shape = body};
  EXPECT_TRUE(without_overlaps(body, again).IsSame(body));
}

TEST_P(OccOverlaps, KeepTheNamesOfFacesAndSolid)
{
  const TopoDS_Shape& solid = GetParam().solid;
  CadFile cad{.shape = solid};
  int number = 0;
  for (const TopoDS_Shape& face : parts_of(solid, TopAbs_FACE)) {
    cad.names.Bind(face, {.name = std::to_string(++number)});
  }
  cad.names.Bind(solid, {.name = "body"});
  const TopoDS_Shape body = without_overlaps(solid, cad);
  ASSERT_TRUE(cad.names.IsBound(body));
  EXPECT_EQ(cad.names.Find(body).name, "body");
  for (const TopoDS_Shape& face : parts_of(body, TopAbs_FACE)) {
    EXPECT_TRUE(cad.names.IsBound(face));
  }
}

// NETGEN takes a gap of zero for detail.
TEST_P(OccOverlaps, TakeNoTriangles)
{
  const tessera::testing::TemporaryFolder folder;
  const auto file = folder.path() / "touching.brep";
  ASSERT_TRUE(BRepTools::Write(GetParam().solid, file.c_str()));
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  surface::CoarseOptions options;
  options.max_size = 1.0;
  const auto surface = netgen::make_coarse_mesher(*model)->mesh_surface(options, {});
  EXPECT_LT(surface.mesh.num_faces(), 1'000);
}

INSTANTIATE_TEST_SUITE_P(Models, OccOverlaps, ::testing::ValuesIn(touching_solids()),
                         name_of_model);

TEST(OccOverlapsOf, ASolidWithANarrowLedgeAreNone)
{
  constexpr double kLedge = 1e-4;
  const TopoDS_Shape solid = united(block(), box({4, 1, 1}, {5, 3, 2 - kLedge}));
  CadFile cad{.shape = solid};
  EXPECT_TRUE(without_overlaps(solid, cad).IsSame(solid));
  EXPECT_TRUE(cad.repairs.empty());
}

// Its inner and outer walls lie on each other as well.
TEST(OccOverlapsOf, ATubeWithoutAWallStayAndAreReported)
{
  const TopoDS_Shape rod = united(block(), disc({2, 2, 2}, 1));
  const TopoDS_Shape solid = without(rod, disc({2, 2, 1}, 1 - kGap, 3));
  CadFile cad{.shape = solid};
  EXPECT_TRUE(without_overlaps(solid, cad).IsSame(solid));
  ASSERT_EQ(cad.repairs.size(), 1U);
  EXPECT_NE(cad.repairs[0].find("left as is"), std::string::npos) << cad.repairs[0];
}

}  // namespace
}  // namespace tessera::cad
