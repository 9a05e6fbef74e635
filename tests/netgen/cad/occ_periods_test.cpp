// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax1.hxx>
#include <gtest/gtest.h>

#include "cad/cad_file.hpp"
#include "cad/heal/periods.hpp"
#include "cad/shape.hpp"

namespace tessera {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// A pin with a rounded foot, which is a surface of revolution: its profile is a Bezier curve.
TopoDS_Shape pin()
{
  TColgp_Array1OfPnt poles(1, 3);
  poles(1) = gp_Pnt(2.0, 0.0, 1.0);
  poles(2) = gp_Pnt(2.0, 0.0, 0.0);
  poles(3) = gp_Pnt(1.0, 0.0, 0.0);
  BRepBuilderAPI_MakeWire wire;
  const auto add = [&](const gp_Pnt& from, const gp_Pnt& to) {
    wire.Add(BRepBuilderAPI_MakeEdge(from, to).Edge());
  };
  add(gp_Pnt(0.0, 0.0, 0.0), gp_Pnt(0.0, 0.0, 8.0));
  add(gp_Pnt(0.0, 0.0, 8.0), gp_Pnt(2.0, 0.0, 8.0));
  add(gp_Pnt(2.0, 0.0, 8.0), gp_Pnt(2.0, 0.0, 1.0));
  wire.Add(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge());
  add(gp_Pnt(1.0, 0.0, 0.0), gp_Pnt(0.0, 0.0, 0.0));
  const TopoDS_Face profile = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  const gp_Ax1 axis(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(0.0, 0.0, 1.0));
  return BRepPrimAPI_MakeRevol(profile, axis).Shape();
}

TopoDS_Face foot_of(const TopoDS_Shape& pin)
{
  for (TopExp_Explorer faces(pin, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current());
    if (!Handle(Geom_SurfaceOfRevolution)::DownCast(BRep_Tool::Surface(face)).IsNull()) return face;
  }
  return {};
}

// One rim's curve a period beside the others, as OpenCASCADE's reader of STEP files puts it.
void move_a_rim(const TopoDS_Face& face)
{
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    if (BRep_Tool::IsClosed(edge, face)) continue;
    double first = 0.0;
    double last = 0.0;
    const auto curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    const auto moved = Handle(Geom2d_Curve)::DownCast(curve->Translated(gp_Vec2d(kTurn, 0.0)));
    BRep_Builder().UpdateEdge(edge, moved, face, BRep_Tool::Tolerance(edge));
    return;
  }
}

// An edge along a rim, twice round, that says to be a point.
TopoDS_Edge false_point(const TopoDS_Face& face)
{
  const TopoDS_Vertex vertex =
      TopExp::FirstVertex(TopoDS::Edge(TopExp_Explorer(face, TopAbs_EDGE).Current()));
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge);
  const Handle(Geom2d_Line) line = new Geom2d_Line(gp_Pnt2d(0.0, 0.0), gp_Dir2d(1.0, 0.0));
  builder.UpdateEdge(edge, line, face, 1e-7);
  builder.Range(edge, 0.0, 2.0 * kTurn);
  builder.Add(edge, vertex.Oriented(TopAbs_FORWARD));
  builder.Add(edge, vertex.Oriented(TopAbs_REVERSED));
  builder.Degenerated(edge, Standard_True);
  return edge;
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind)
{
  return static_cast<int>(cad::parts_of(shape, kind).size());
}

TEST(OccPeriods, CurveInAnotherPeriodIsMovedBack)
{
  const TopoDS_Shape shape = pin();
  const double volume = cad::volume_of(shape);
  move_a_rim(foot_of(shape));
  ASSERT_FALSE(BRepCheck_Analyzer(shape).IsValid());
  ShapeBuild_ReShape changes;
  const TopoDS_Shape closed = cad::with_closed_wires(shape, changes);
  EXPECT_TRUE(BRepCheck_Analyzer(closed).IsValid());
  EXPECT_NEAR(cad::volume_of(closed), volume, 1e-9 * volume);
}

TEST(OccPeriods, EdgeThatIsFalselyAPointIsLeftOut)
{
  const TopoDS_Shape shape = pin();
  ASSERT_FALSE(cad::has_false_points(shape));
  const TopoDS_Face foot = foot_of(shape);
  TopoDS_Wire wire = TopoDS::Wire(TopExp_Explorer(foot, TopAbs_WIRE).Current());
  wire.Free(Standard_True);
  BRep_Builder().Add(wire, false_point(foot));
  ASSERT_TRUE(cad::has_false_points(shape));
  ShapeBuild_ReShape changes;
  const TopoDS_Shape closed = cad::with_closed_wires(shape, changes);
  EXPECT_FALSE(cad::has_false_points(closed));
  EXPECT_TRUE(BRepCheck_Analyzer(closed).IsValid());
  EXPECT_EQ(count(closed, TopAbs_EDGE), count(pin(), TopAbs_EDGE));
}

TEST(OccPeriods, SolidKeepsItsFaces)
{
  cad::CadFile cad{.shape = pin()};
  const double volume = cad::volume_of(cad.shape);
  const int num_faces = count(cad.shape, TopAbs_FACE);
  move_a_rim(foot_of(cad.shape));
  cad::make_closed_solids(cad, {});
  EXPECT_EQ(count(cad.shape, TopAbs_FACE), num_faces);
  EXPECT_NEAR(cad::volume_of(cad.shape), volume, 1e-9 * volume);
  ASSERT_EQ(cad.repairs.size(), 1U);
  EXPECT_NE(cad.repairs[0].find("periodic"), std::string::npos) << cad.repairs[0];
}

TEST(OccPeriods, SoundSolidIsLeftAlone)
{
  const TopoDS_Shape shape = pin();
  ASSERT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  ShapeBuild_ReShape changes;
  EXPECT_TRUE(cad::with_closed_wires(shape, changes).IsSame(shape));
  cad::CadFile cad{.shape = shape};
  cad::make_closed_solids(cad, {});
  EXPECT_TRUE(cad.repairs.empty()) << cad.repairs.front();
}

}  // namespace
}  // namespace tessera
