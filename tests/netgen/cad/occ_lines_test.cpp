// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Circ.hxx>
#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/coarse/optimize_interior.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/cut_meshes.hpp"
#include "support/temporary_folder.hpp"

#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using model::AssemblyOptions;
using model::Polyline;
using Edges = std::set<std::array<LocalIndex, 2>>;

constexpr double kRounding = 1e-9;

// A cube of side 1, alone or with edges beside it in the file.
class OccLines : public ::testing::Test {
 protected:
  void add(const TopoDS_Shape& edge) { loose_.push_back(edge); }

  [[nodiscard]] model::ModelSource read(const AssemblyOptions& options) const
  {
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    BRep_Builder().Add(compound, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
    for (const TopoDS_Shape& edge : loose_) BRep_Builder().Add(compound, edge);
    const auto file = folder_.path() / "cube.brep";
    BRepTools::Write(compound, file.c_str());
    return netgen::import_model(file, {.assembly = options});
  }

  [[nodiscard]] mesh::CoarseMesh mesh(const AssemblyOptions& options) const
  {
    const auto model = netgen::load_model(read(options));
    auto mesh = testing::coarse_mesh_of(*model, 0.25, surface::SurfaceMesher::remesh);
    netgen::name_curves(*model, mesh);
    return mesh;
  }

  [[nodiscard]] mesh::CoarseMesh with_line(std::vector<Vec3> points) const
  {
    return mesh({.embedded = {{"well", Polyline{std::move(points)}}}});
  }

 private:
  std::vector<TopoDS_Shape> loose_{};
  testing::TemporaryFolder folder_{};
};

Edges edges_of_tets(const mesh::CoarseMesh& mesh)
{
  Edges edges;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    for (const auto& [i, j] : mesh::kTetEdgeCorners) {
      const LocalIndex a = mesh.tet(t)[i];
      const LocalIndex b = mesh.tet(t)[j];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return edges;
}

// Of each line, of segments that are edges of tets.
std::map<std::string, double> lengths_of(const mesh::CoarseMesh& mesh)
{
  const std::map<LocalIndex, LocalIndex> lines = mesh::lines_by_curve(mesh);
  const std::vector<std::string> names = mesh::line_names(mesh);
  const Edges edges = edges_of_tets(mesh);
  Edges seen;
  std::map<std::string, double> lengths;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const auto line = lines.find(mesh.segment_curve[at(s)]);
    const LocalIndex a = mesh.segment_vertices[2 * at(s)];
    const LocalIndex b = mesh.segment_vertices[2 * at(s) + 1];
    const std::array ends{std::min(a, b), std::max(a, b)};
    if (line == lines.end() || !seen.insert(ends).second) continue;
    EXPECT_TRUE(edges.contains(ends));
    lengths[names[at(line->second)]] += norm(mesh.position(b) - mesh.position(a));
  }
  return lengths;
}

void expect_one_body(const mesh::CoarseMesh& mesh)
{
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_EQ(mesh::body_names(mesh).size(), 1U);
  double volume = 0.0;
  for (LocalIndex m = 1; m <= mesh.num_materials(); ++m) volume += testing::volume_of(mesh, m);
  EXPECT_NEAR(volume, 1.0, kRounding);
  EXPECT_TRUE(mesh::inside_patch_names(mesh).empty());
}

TEST_F(OccLines, ALineMayEndInsideAndStickOut)
{
  const auto mesh = with_line({{0.3, 0.4, 1.5}, {0.3, 0.4, 0.5}, {0.7, 0.6, 0.3}});
  expect_one_body(mesh);
  const double below = norm(Vec3{0.4, 0.2, -0.2});
  EXPECT_NEAR(lengths_of(mesh).at("well"), 0.5 + below, kRounding);
}

TEST_F(OccLines, ALineMayGoThroughABodyOrAround)
{
  const auto through = with_line({{-1, 0.3, 0.4}, {2, 0.5, 0.7}});
  expect_one_body(through);
  EXPECT_NEAR(lengths_of(through).at("well"), norm(Vec3{3.0, 0.2, 0.3}) / 3.0, kRounding);
  const auto around =
      with_line({{0.3, 0.3, 0.5}, {0.7, 0.3, 0.5}, {0.5, 0.7, 0.5}, {0.3, 0.3, 0.5}});
  expect_one_body(around);
  EXPECT_NEAR(lengths_of(around).at("well"), 0.4 + 2.0 * norm(Vec3{0.2, 0.4, 0.0}), kRounding);
}

TEST_F(OccLines, ALineMayLieOnTheSurface)
{
  const auto mesh = with_line({{0.2, 0.3, 1.0}, {0.8, 0.6, 1.0}});
  expect_one_body(mesh);
  EXPECT_NEAR(lengths_of(mesh).at("well"), norm(Vec3{0.6, 0.3, 0.0}), kRounding);
}

TEST_F(OccLines, StayWhenTheInsideIsOptimized)
{
  auto mesh = with_line({{0.3, 0.4, 1.0}, {0.35, 0.45, 0.5}, {0.7, 0.6, 0.3}});
  const auto before = lengths_of(mesh);
  EXPECT_GT(coarse::optimize_interior(mesh).num_moves, 0);
  EXPECT_EQ(lengths_of(mesh), before);
}

TEST_F(OccLines, CurvesOfTheFileAreLinesIfTheyAreAskedFor)
{
  const gp_Circ circle(gp_Ax2(gp_Pnt(0.5, 0.5, 0.5), gp_Dir(0, 0, 1)), 0.3);
  add(BRepBuilderAPI_MakeEdge(circle, 0.0, std::numbers::pi).Edge());
  const auto dropped = read({});
  EXPECT_TRUE(dropped.assembly.lines.empty());
  ASSERT_EQ(dropped.repairs.size(), 1U);
  EXPECT_NE(dropped.repairs.front().find("geometry.loose_curves"), std::string::npos);
  const AssemblyOptions asked{.loose_curves = model::LooseParts::embed};
  EXPECT_NEAR(read(asked).assembly.lines.at(0).length, 0.3 * std::numbers::pi, 1e-6);
  const auto mesh = this->mesh(asked);
  expect_one_body(mesh);
  ASSERT_EQ(mesh::line_names(mesh).size(), 1U);
  EXPECT_EQ(mesh::line_names(mesh).front().substr(0, 6), "curve_");
  EXPECT_NEAR(lengths_of(mesh).begin()->second, 0.3 * std::numbers::pi, 0.02);
}

TEST_F(OccLines, AClosedCurveIsALineToo)
{
  const gp_Circ circle(gp_Ax2(gp_Pnt(0.5, 0.5, 0.5), gp_Dir(1, 0, 0)), 0.3);
  add(BRepBuilderAPI_MakeEdge(circle).Edge());
  const auto mesh = this->mesh({.loose_curves = model::LooseParts::embed});
  expect_one_body(mesh);
  EXPECT_NEAR(lengths_of(mesh).begin()->second, 0.6 * std::numbers::pi, 0.04);
}

TEST_F(OccLines, WhatLinesShareHasTheNameOfTheFirst)
{
  const Polyline well{{{0.3, 0.4, 1.0}, {0.3, 0.4, 0.5}}};
  const Polyline track{{{0.3, 0.4, 0.8}, {0.3, 0.4, 0.5}, {0.6, 0.4, 0.3}}};
  const auto mesh = this->mesh({.embedded = {{"well", well}, {"track", track}}});
  EXPECT_NEAR(lengths_of(mesh).at("well"), 0.5, kRounding);
  EXPECT_NEAR(lengths_of(mesh).at("track"), norm(Vec3{0.3, 0.0, -0.2}), kRounding);
  const std::string text = testing::message_of<GeometryError>([&] {
    (void)read({.embedded = {{"well", well}, {"again", well}}});
  });
  EXPECT_NE(text.find("\"again\" lies on other lines altogether"), std::string::npos) << text;
}

TEST_F(OccLines, ALineAlongAnEdgeOfTheModelIsThatEdge)
{
  const auto mesh = with_line({{0.0, 0.0, 0.25}, {0.0, 0.0, 0.75}});
  expect_one_body(mesh);
  EXPECT_NEAR(lengths_of(mesh).at("well"), 0.5, kRounding);
}

TEST_F(OccLines, WhatLiesOutsideIsLeftOutAndTold)
{
  add(BRepBuilderAPI_MakeEdge(gp_Pnt(2, 0, 0), gp_Pnt(2, 1, 0)).Edge());
  const auto source = read({.loose_curves = model::LooseParts::embed});
  EXPECT_TRUE(source.assembly.lines.empty());
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_NE(source.repairs.front().find("outside of all solids were left out: 1"),
            std::string::npos);
  const std::string text = testing::message_of<GeometryError>([&] {
    (void)with_line({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 + 1e-9}, {0.5, 0.5, 0.2}});
  });
  EXPECT_NE(text.find("points 1 and 2 of its polyline are one"), std::string::npos) << text;
}

TEST_F(OccLines, LinesThatLeaveNoDirectionAreRefusedWithAPlace)
{
  std::vector<Vec3> points{{0.5, 0.5, 0.5}};
  for (const Vec3& way :
       {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 0}, Vec3{1, -1, 0}, Vec3{1, 0, 1},
        Vec3{1, 0, -1}, Vec3{0, 1, 1}, Vec3{0, 1, -1}, Vec3{1, 1, 1}, Vec3{1, 1, -1},
        Vec3{1, -1, 1}, Vec3{-1, 1, 1}}) {
    points.push_back(points.back() + 0.01 * way);
  }
  const std::string text = testing::message_of<NetgenError>([&] { (void)with_line(points); });
  EXPECT_NE(text.find("no direction is across all of them"), std::string::npos) << text;
}

}  // namespace
}  // namespace tessera
