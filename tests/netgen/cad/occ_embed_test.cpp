// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <numbers>
#include <string>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax3.hxx>
#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/face_tets.hpp"

#include "support/cut_meshes.hpp"
#include "support/temporary_folder.hpp"

#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using model::AssemblyOptions;
using model::Disk;
using model::Polygon;

constexpr double kRounding = 1e-9;

Polygon rectangle(double x, double low_z, double high_z)
{
  return {{{x, -1, low_z}, {x, 2, low_z}, {x, 2, high_z}, {x, -1, high_z}}};
}

// A cube of side 1, alone or with faces beside it in the file.
class OccEmbed : public ::testing::Test {
 protected:
  void add(const TopoDS_Shape& face) { loose_.push_back(face); }

  [[nodiscard]] model::ModelSource read(const AssemblyOptions& options = {}) const
  {
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    BRep_Builder().Add(compound, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
    for (const TopoDS_Shape& face : loose_) BRep_Builder().Add(compound, face);
    const auto file = folder_.path() / "cube.brep";
    BRepTools::Write(compound, file.c_str());
    return netgen::import_model(file, {.assembly = options});
  }

  [[nodiscard]] mesh::CoarseMesh mesh(const AssemblyOptions& options = {},
                                      double max_size = 0.25) const
  {
    return testing::coarse_mesh_of(*netgen::load_model(read(options)), max_size,
                                   surface::SurfaceMesher::remesh);
  }

  std::vector<TopoDS_Shape> loose_{};
  testing::TemporaryFolder folder_{};
};

TopoDS_Shape part_of_a_cylinder(double radius, double from, double to)
{
  const gp_Ax3 axis(gp_Pnt(0.5, 0.5, 0.5), gp_Dir(0, 0, 1));
  return BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axis, radius), from, to, -0.3, 0.3,
                                 1e-7)
      .Face();
}

TopoDS_Shape wavy_face()
{
  TColgp_Array2OfPnt points(1, 6, 1, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double height = 0.5 + 0.1 * std::sin(0.8 * i) * std::cos(0.6 * j);
      points.SetValue(i + 1, j + 1, gp_Pnt(0.2 + 0.12 * i, 0.2 + 0.12 * j, height));
    }
  }
  return BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(points).Surface(), 1e-7).Face();
}

// Area of the faces of each patch name.
std::map<std::string, double> areas_of(const mesh::CoarseMesh& mesh)
{
  std::map<std::string, double> areas;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    areas[mesh.patch_names[at(mesh.face_patch[at(f)])]] +=
        triangle_area(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
  }
  return areas;
}

// Of one body, whose inner faces lie between two materials, and whose volume nothing changes.
void expect_one_body(const mesh::CoarseMesh& mesh)
{
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_EQ(mesh::body_names(mesh).size(), 1U);
  double volume = 0.0;
  for (LocalIndex m = 1; m <= mesh.num_materials(); ++m) {
    EXPECT_EQ(mesh.body(m), 1);
    volume += testing::volume_of(mesh, m);
  }
  EXPECT_NEAR(volume, 1.0, kRounding);
  const auto triangles = mesh::triangles_of_tets(mesh.tet_vertices);
  LocalIndex face = 0;
  for (const mesh::TriangleTets& triangle : mesh::tets_of_faces(mesh, triangles)) {
    const LocalIndex patch = mesh.face_patch[at(face++)];
    const bool is_inside = mesh.patch_is_inside[at(patch)] != 0;
    ASSERT_EQ(triangle.tets[1] != kNoIndex, is_inside);
    if (!is_inside) continue;
    EXPECT_NE(mesh.tet_material[at(triangle.tets[0])], mesh.tet_material[at(triangle.tets[1])]);
  }
}

TEST_F(OccEmbed, AFaceMayEndInsideOfABody)
{
  const auto mesh = this->mesh({.embedded = {{"sheet", rectangle(0.3, -0.1, 0.45)}}});
  expect_one_body(mesh);
  EXPECT_NEAR(areas_of(mesh).at("sheet"), 0.45, kRounding);
  EXPECT_EQ(mesh::inside_patch_names(mesh), std::vector<std::string>{"sheet"});
  EXPECT_EQ(mesh.num_patches(), 8);  // The bottom is cut in two.
}

TEST_F(OccEmbed, AFaceMayLieInTheMiddleOfABody)
{
  const Disk disk{.centre = {0.5, 0.5, 0.5}, .normal = {1, 2, 3}, .radius = 0.3};
  const auto mesh = this->mesh({.embedded = {{"disk", disk}}}, 0.15);
  expect_one_body(mesh);
  EXPECT_EQ(mesh.num_patches(), 7);
  EXPECT_NEAR(areas_of(mesh).at("disk"), 0.09 * std::numbers::pi, 0.05 * 0.28);
}

TEST_F(OccEmbed, AFaceMayDivideABodyWhichStaysOne)
{
  const auto source = read({.embedded = {{"sheet", rectangle(0.3, -1, 2)}}});
  const auto mesh = this->mesh({.embedded = {{"sheet", rectangle(0.3, -1, 2)}}});
  expect_one_body(mesh);
  EXPECT_EQ(mesh.num_materials(), 2);
  EXPECT_NEAR(areas_of(mesh).at("sheet"), 1.0, kRounding);
  const auto described = netgen::describe_model(*netgen::load_model(source));
  ASSERT_EQ(described.solids.size(), 1U);
  EXPECT_NEAR(described.solids.front().volume, 1.0, kRounding);
  EXPECT_EQ(std::ranges::count(described.faces, true, &model::FaceDescription::is_inside), 1);
}

TEST_F(OccEmbed, FacesMayCrossEachOther)
{
  const auto mesh = this->mesh(
      {.embedded = {
           {"a", rectangle(0.3, -1, 0.7)},
           {"b", Polygon{{{0.1, 0.2, 0.4}, {0.8, 0.2, 0.4}, {0.8, 0.7, 0.4}, {0.1, 0.7, 0.4}}}}}});
  expect_one_body(mesh);
  EXPECT_NEAR(areas_of(mesh).at("a"), 0.7, kRounding);
  EXPECT_NEAR(areas_of(mesh).at("b"), 0.35, kRounding);
}

TEST_F(OccEmbed, RoundAndFreeFormFacesOfAFileAreContinuedOnTheirSurfaces)
{
  for (const auto& [face, is_tube] :
       {std::pair(part_of_a_cylinder(0.3, 0.2, 2.2), false),
        std::pair(part_of_a_cylinder(0.3, 0.0, 2.0 * std::numbers::pi), true),
        std::pair(wavy_face(), false)}) {
    loose_ = {face};
    expect_one_body(this->mesh());
    EXPECT_EQ(read().assembly.embedded.size(), 1U);
    EXPECT_EQ(is_tube, read().assembly.embedded.front().area > 1.0);
  }
}

TEST_F(OccEmbed, AFaceOnTheSurfaceIsAPatchThere)
{
  const Polygon lid{{{0.2, 0.2, 1}, {0.7, 0.2, 1}, {0.7, 0.7, 1}, {0.2, 0.7, 1}}};
  const auto mesh = this->mesh({.embedded = {{"lid", lid}}});
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_NEAR(areas_of(mesh).at("lid"), 0.25, kRounding);
  EXPECT_TRUE(mesh::inside_patch_names(mesh).empty());
}

TEST_F(OccEmbed, PiecesOfAFaceKnowItsNumber)
{
  const auto source = read({.embedded = {{"sheet", rectangle(0.3, -0.1, 0.45)}}});
  const auto described = netgen::describe_model(*netgen::load_model(source));
  std::map<LocalIndex, int> num_pieces;
  for (const model::FaceDescription& face : described.faces) ++num_pieces[face.given_number()];
  EXPECT_EQ(num_pieces[0], 1);  // The sheet.
  int num_cut = 0;
  for (LocalIndex number = 1; number <= 6; ++number) {
    EXPECT_GE(num_pieces[number], 1);
    num_cut += num_pieces[number] == 2 ? 1 : 0;
  }
  EXPECT_EQ(num_cut, 1);  // Of the sides only slits are cut into; the bottom falls apart.
}

TEST_F(OccEmbed, LooseFacesMayBeDropped)
{
  add(part_of_a_cylinder(0.3, 0.2, 2.2));
  const auto source = read({.loose_faces = model::LooseParts::drop});
  EXPECT_TRUE(source.assembly.embedded.empty());
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_NE(source.repairs.front().find("left out: 1"), std::string::npos);
}

TEST_F(OccEmbed, AFaceOfTheCaseOutsideOfAllSolidsIsRefused)
{
  const std::string text = testing::message_of<GeometryError>([&] {
    (void)read({.embedded = {{"far", rectangle(3, 0, 1)}}});
  });
  EXPECT_NE(text.find("[[embed]] \"far\" lies outside of all solids"), std::string::npos) << text;
}

}  // namespace
}  // namespace tessera
