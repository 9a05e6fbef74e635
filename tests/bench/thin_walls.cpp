// SPDX-License-Identifier: BSD-3-Clause
// Writes models with thin walls and narrow gaps, as BREP and as STL, for remesh_bench and corpus:
//   thin_walls FOLDER
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <StlAPI_Writer.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>

namespace {

namespace fs = std::filesystem;

// Triangles of the STL files may be off the shape by this part of the wall or gap.
constexpr double kDeflectionOfWall = 0.15;

struct ThinModel {
  std::string name{};
  double wall = 0.0;  // Or gap.
  std::function<TopoDS_Shape(double wall)> make{};
};

const gp_Ax1 kUp(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));

// A box with round edges, open at the top.
TopoDS_Shape tray(double wall)
{
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(100.0, 60.0, 40.0).Shape();
  BRepFilletAPI_MakeFillet round(box);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(box, TopAbs_EDGE, edges);
  for (int e = 1; e <= edges.Extent(); ++e) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(e));
    const double z = BRep_Tool::Pnt(TopExp::FirstVertex(edge)).Z()
                     + BRep_Tool::Pnt(TopExp::LastVertex(edge)).Z();
    if (z < 79.0) round.Add(8.0, edge);
  }
  const TopoDS_Shape body = round.Shape();
  TopTools_ListOfShape open;
  for (TopExp_Explorer faces(body, TopAbs_FACE); faces.More(); faces.Next()) {
    bool is_top = true;
    for (TopExp_Explorer ends(faces.Current(), TopAbs_VERTEX); ends.More(); ends.Next()) {
      is_top = is_top && BRep_Tool::Pnt(TopoDS::Vertex(ends.Current())).Z() > 39.9;
    }
    if (is_top) open.Append(faces.Current());
  }
  BRepOffsetAPI_MakeThickSolid hollow;
  hollow.MakeThickSolidByJoin(body, open, -wall, 1e-4);
  return hollow.Shape();
}

// A wire whose turns nearly touch.
TopoDS_Shape coil(double gap)
{
  constexpr double kTurns = 4.0;
  const Handle(Geom_CylindricalSurface) mantle =
      new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 10.0);
  const double pitch = 2.0 + gap;
  const double angle = 2.0 * std::numbers::pi * kTurns;
  const Handle(Geom2d_TrimmedCurve) line =
      GCE2d_MakeSegment(gp_Pnt2d(0.0, 0.0), gp_Pnt2d(angle, pitch * kTurns)).Value();
  const TopoDS_Edge spine = BRepBuilderAPI_MakeEdge(line, mantle).Edge();
  BRepLib::BuildCurve3d(spine);
  BRepOffsetAPI_MakePipeShell pipe(BRepBuilderAPI_MakeWire(spine).Wire());
  pipe.SetMode(gp_Dir(0, 0, 1));
  const gp_Circ circle(gp_Ax2(gp_Pnt(10, 0, 0), gp_Dir(0, 1, 0)), 1.0);
  pipe.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire());
  pipe.Build();
  pipe.MakeSolid();
  return pipe.Shape();
}

TopoDS_Shape hollow_ball(double wall)
{
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(10.0).Shape(),
                         BRepPrimAPI_MakeSphere(10.0 - wall).Shape())
      .Shape();
}

TopoDS_Edge edge_between(const gp_Pnt& a, const gp_Pnt& b)
{
  return BRepBuilderAPI_MakeEdge(a, b).Edge();
}

// Round the z axis, a whole turn.
TopoDS_Shape revolved(const std::vector<TopoDS_Edge>& edges)
{
  BRepBuilderAPI_MakeWire wire;
  for (const TopoDS_Edge& edge : edges) wire.Add(edge);
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), kUp).Shape();
}

// The part of a hollow ball of radius 100 within 30 degrees of its lowest point, with a hole.
TopoDS_Shape dish(double wall)
{
  const auto on = [](double radius, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return gp_Pnt(radius * std::sin(angle), 0.0, -radius * std::cos(angle));
  };
  const auto arc = [&](double radius) {
    return BRepBuilderAPI_MakeEdge(
               GC_MakeArcOfCircle(on(radius, 3), on(radius, 15), on(radius, 30)).Value())
        .Edge();
  };
  const double inner = 100.0 - wall;
  return revolved({arc(100.0), edge_between(on(100.0, 30), on(inner, 30)), arc(inner),
                   edge_between(on(inner, 3), on(100.0, 3))});
}

// Round walls on a plate, one inside the other.
TopoDS_Shape fins(double wall)
{
  TopoDS_Shape body = BRepPrimAPI_MakeCylinder(30.0, 3.0).Shape();
  for (double radius = 28.0; radius > 15.0; radius -= 4.0) {
    const TopoDS_Shape fin = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, 20.0).Shape(),
                                             BRepPrimAPI_MakeCylinder(radius - wall, 20.0).Shape())
                                 .Shape();
    body = BRepAlgoAPI_Fuse(body, fin).Shape();
  }
  return body;
}

// A pipe whose radius goes up and down.
TopoDS_Shape bellows(double wall)
{
  const auto profile = [](double inwards) {
    constexpr int kPoints = 61;
    Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints);
    for (int i = 0; i < kPoints; ++i) {
      const double z = 0.5 * i;
      const double slope = 2.0 * std::cos(z);
      const double across = inwards / std::hypot(1.0, slope);
      points->SetValue(i + 1, gp_Pnt(10.0 + 2.0 * std::sin(z) - across, 0.0, z + slope * across));
    }
    GeomAPI_Interpolate curve(points, Standard_False, 1e-9);
    curve.Perform();
    return curve.Curve();
  };
  const Handle(Geom_BSplineCurve) outer = profile(0.0);
  const Handle(Geom_BSplineCurve) inner = profile(wall);
  return revolved({BRepBuilderAPI_MakeEdge(outer).Edge(),
                   edge_between(outer->EndPoint(), inner->EndPoint()),
                   BRepBuilderAPI_MakeEdge(inner).Edge(),
                   edge_between(inner->StartPoint(), outer->StartPoint())});
}

TopoDS_Shape plate(double wall)
{
  return BRepAlgoAPI_Cut(
             BRepPrimAPI_MakeBox(100.0, 100.0, wall).Shape(),
             BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(40, 40, -1), gp_Dir(0, 0, 1)), 10.0, wall + 2.0)
                 .Shape())
      .Shape();
}

void write(const ThinModel& model, const fs::path& folder)
{
  const TopoDS_Shape shape = model.make(model.wall);
  const std::string stem = (folder / model.name).string();
  BRepTools::Clean(shape);
  if (!BRepTools::Write(shape, (stem + ".brep").c_str())) {
    throw std::runtime_error(stem + ".brep cannot be written");
  }
  const BRepMesh_IncrementalMesh triangles(shape, kDeflectionOfWall * model.wall, Standard_False,
                                           0.3);
  StlAPI_Writer writer;
  if (!writer.Write(shape, (stem + ".stl").c_str())) {
    throw std::runtime_error(stem + ".stl cannot be written");
  }
}

void run(const fs::path& folder)
{
  fs::create_directories(folder);
  const std::vector<ThinModel> models{
      {"tray", 0.5, tray},       {"coil", 0.1, coil}, {"hollow_ball", 0.07, hollow_ball},
      {"dish", 0.3, dish},       {"fins", 0.2, fins}, {"bellows", 0.1, bellows},
      {"thin_plate", 0.3, plate}};
  for (const ThinModel& model : models) write(model, folder);
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::fprintf(stderr, "usage: thin_walls FOLDER\n");
    return 64;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  } catch (const Standard_Failure& error) {
    std::fprintf(stderr, "error: %s\n", error.GetMessageString());
    return 1;
  }
  return 0;
}
