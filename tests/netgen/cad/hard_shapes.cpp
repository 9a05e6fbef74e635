// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/cad/hard_shapes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>

namespace tessera::testing {

TopoDS_Shape bearing(std::initializer_list<double> angles)
{
  constexpr double kMiddle = 9.5;  // Radius of the circle on which the balls' centres are.
  constexpr double kBall = 2.0;
  const auto cylinder = [](double radius) {
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -5), gp::DZ()), radius, 10.0).Shape();
  };
  const TopoDS_Shape groove = BRepPrimAPI_MakeTorus(kMiddle, kBall);
  const TopoDS_Shape pipe = BRepAlgoAPI_Cut(cylinder(13.5), cylinder(10.5)).Shape();
  TopoDS_Compound parts;
  BRep_Builder().MakeCompound(parts);
  BRep_Builder().Add(parts, BRepAlgoAPI_Cut(cylinder(8.5), groove).Shape());
  BRep_Builder().Add(parts, BRepAlgoAPI_Cut(pipe, groove).Shape());
  for (const double angle : angles) {
    const gp_Pnt centre(kMiddle * std::cos(angle), kMiddle * std::sin(angle), 0);
    BRep_Builder().Add(parts, BRepPrimAPI_MakeSphere(centre, kBall).Shape());
  }
  BRep_Builder().Add(parts, BRepPrimAPI_MakeBox(gp_Pnt(-3, -3, 5), 6.0, 6.0, 6.0).Shape());
  return parts;
}

TopoDS_Shape overlapping_boxes(double overlap)
{
  TopoDS_Compound boxes;
  BRep_Builder().MakeCompound(boxes);
  BRep_Builder().Add(boxes, BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape());
  BRep_Builder().Add(boxes,
                     BRepPrimAPI_MakeBox(gp_Pnt(1.0 - overlap, 0.2, 0.2), 1, 0.6, 0.6).Shape());
  return boxes;
}

TopoDS_Shape cusp()
{
  const gp_Pnt tip(0.0, 0.0, 0.0);
  const gp_Pnt end(std::sin(std::numbers::pi / 3.0), 0.5, 0.0);
  const std::array<gp_Pnt, 4> corners{tip, gp_Pnt(1.2, 0.0, 0.0), gp_Pnt(1.2, 0.5, 0.0), end};
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < 3; ++i) wire.Add(BRepBuilderAPI_MakeEdge(corners[i], corners[i + 1]));
  const gp_Circ circle(gp_Ax2(gp_Pnt(0.0, 1.0, 0.0), gp_Dir(0.0, 0.0, 1.0)), 1.0);
  wire.Add(BRepBuilderAPI_MakeEdge(circle, tip, end));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0.0, 0.0, 0.5)).Shape();
}

TopoDS_Shape rounded_block(double radius)
{
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 4, 4, 3).Shape();
  BRepFilletAPI_MakeFillet fillet(block);
  for (TopExp_Explorer edges(block, TopAbs_EDGE); edges.More(); edges.Next())
    fillet.Add(radius, TopoDS::Edge(edges.Current()));
  return fillet.Shape();
}

TopoDS_Shape shoulder(double ledge)
{
  const TopoDS_Shape wide = BRepPrimAPI_MakeCylinder(20.0, 5.0).Shape();
  const gp_Ax2 top(gp_Pnt(0, 0, 5), gp_Dir(0, 0, 1));
  const TopoDS_Shape thin = BRepPrimAPI_MakeCylinder(top, 20.0 - ledge, 5.0).Shape();
  return BRepAlgoAPI_Fuse(wide, thin).Shape();
}

}  // namespace tessera::testing
