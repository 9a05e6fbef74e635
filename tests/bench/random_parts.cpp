// SPDX-License-Identifier: BSD-3-Clause
#include "random_parts.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Ax1.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

namespace {

double diagonal(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  return std::sqrt(box.SquareExtent());
}

// Corners round (x, 0, z), star-shaped, so that no two sides cross.
std::vector<gp_Pnt> random_corners(Dice& dice, const gp_Pnt& centre)
{
  const int count = 3 + dice.below(7);
  std::vector<gp_Pnt> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + dice.between(-0.35, 0.35)) / count;
    const double radius = dice.between(0.3, 1.0);
    corners.emplace_back(centre.X() + radius * std::cos(angle), centre.Y(),
                         centre.Z() + radius * std::sin(angle));
  }
  return corners;
}

TopoDS_Wire smooth_wire(const std::vector<gp_Pnt>& corners)
{
  const Handle(TColgp_HArray1OfPnt) points =
      new TColgp_HArray1OfPnt(1, static_cast<int>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points->SetValue(static_cast<int>(i) + 1, corners[i]);
  }
  GeomAPI_Interpolate curve(points, true, 1e-9);
  curve.Perform();
  if (!curve.IsDone()) throw Rejected("no curve through the corners");
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve.Curve()).Edge()).Wire();
}

// Straight sides, and arcs that bulge by up to a quarter of their length.
TopoDS_Wire wire_with_arcs(const std::vector<gp_Pnt>& corners, Dice& dice)
{
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const gp_Pnt &from = corners[i], &to = corners[(i + 1) % corners.size()];
    if (!dice.chance(0.4)) {
      wire.Add(BRepBuilderAPI_MakeEdge(from, to).Edge());
      continue;
    }
    const gp_Vec side(from, to);
    const gp_Pnt middle =
        gp_Pnt((from.XYZ() + to.XYZ()) / 2.0)
            .Translated(side.Crossed(gp_Vec(gp::DY())) * dice.between(0.05, 0.25));
    wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, middle, to).Value()).Edge());
  }
  if (!wire.IsDone()) throw Rejected("the profile has no wire");
  return wire.Wire();
}

TopoDS_Wire random_wire(Dice& dice, const gp_Pnt& centre)
{
  const std::vector<gp_Pnt> corners = random_corners(dice, centre);
  if (dice.chance(0.25)) return smooth_wire(corners);
  return wire_with_arcs(corners, dice);
}

TopoDS_Face face_in(const TopoDS_Wire& wire)
{
  BRepBuilderAPI_MakeFace face(wire, true);
  if (!face.IsDone()) throw Rejected("the profile is not plane");
  return face.Face();
}

// A half profile with a side on the axis, so that turning it makes poles or an apex.
TopoDS_Wire wire_on_axis(Dice& dice)
{
  BRepBuilderAPI_MakePolygon polygon;
  polygon.Add(gp_Pnt(0.0, 0.0, -1.0));
  const int count = 1 + dice.below(4);
  for (int i = 0; i < count; ++i) {
    polygon.Add(gp_Pnt(dice.between(0.2, 1.2), 0.0, -0.9 + 1.8 * (i + 0.5) / count));
  }
  polygon.Add(gp_Pnt(0.0, 0.0, 1.0));
  polygon.Close();
  return polygon.Wire();
}

TopoDS_Shape extruded(Dice& dice)
{
  const double slant = dice.chance(0.3) ? 0.5 : 0.0;
  const gp_Vec along(dice.between(-slant, slant + 1e-12), dice.between(0.3, 3.0),
                     dice.between(-slant, slant + 1e-12));
  return BRepPrimAPI_MakePrism(face_in(random_wire(dice, gp::Origin())), along).Shape();
}

TopoDS_Shape turned(Dice& dice)
{
  const bool on_axis = dice.chance(0.4);
  const TopoDS_Wire wire =
      on_axis ? wire_on_axis(dice) : random_wire(dice, gp_Pnt(dice.between(1.5, 3.0), 0.0, 0.0));
  const double whole = 2.0 * std::numbers::pi;
  const double angle = dice.chance(0.5) ? whole : dice.between(0.1, 0.95) * whole;
  return BRepPrimAPI_MakeRevol(face_in(wire), gp_Ax1(gp::Origin(), gp::DZ()), angle).Shape();
}

TopoDS_Shape lofted(Dice& dice)
{
  BRepOffsetAPI_ThruSections loft(true, dice.chance(0.5));
  loft.AddWire(wire_with_arcs(random_corners(dice, gp::Origin()), dice));
  loft.AddWire(random_wire(dice, gp_Pnt(dice.between(-0.5, 0.5), dice.between(1.0, 2.5), 0.0)));
  loft.Build();
  if (!loft.IsDone()) throw Rejected("the loft fails");
  return loft.Shape();
}

TopoDS_Shape rounded_edges(const TopoDS_Shape& part, const TopTools_IndexedMapOfShape& edges,
                           Dice& dice)
{
  const double radius = diagonal(part) * dice.between(0.01, 0.06);
  const int count = 1 + dice.below(4);
  BRepFilletAPI_MakeFillet fillet(part);
  for (int i = 0; i < count; ++i) {
    fillet.Add(radius, TopoDS::Edge(edges(1 + dice.below(edges.Extent()))));
  }
  fillet.Build();
  if (!fillet.IsDone()) throw Rejected("the rounding fails");
  return fillet.Shape();
}

TopoDS_Shape cut_edges(const TopoDS_Shape& part, const TopTools_IndexedMapOfShape& edges,
                       Dice& dice)
{
  const double width = diagonal(part) * dice.between(0.01, 0.06);
  const int count = 1 + dice.below(3);
  BRepFilletAPI_MakeChamfer chamfer(part);
  for (int i = 0; i < count; ++i) {
    chamfer.Add(width, TopoDS::Edge(edges(1 + dice.below(edges.Extent()))));
  }
  chamfer.Build();
  if (!chamfer.IsDone()) throw Rejected("the chamfer fails");
  return chamfer.Shape();
}

TopoDS_Shape hollow(const TopoDS_Shape& part, Dice& dice)
{
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(part, TopAbs_FACE, faces);
  TopTools_ListOfShape open;
  open.Append(faces(1 + dice.below(faces.Extent())));
  BRepOffsetAPI_MakeThickSolid thick;
  thick.MakeThickSolidByJoin(part, open, -diagonal(part) * dice.between(0.01, 0.05), 1e-4);
  if (!thick.IsDone()) throw Rejected("it cannot be made hollow");
  return thick.Shape();
}

// Boxes and cylinders on top of each other, so that they have a part of a face in common.
TopTools_ListOfShape stacked_bodies(Dice& dice, int count)
{
  TopTools_ListOfShape bodies;
  double z = 0.0;
  for (int i = 0; i < count; ++i) {
    Body body;
    body.kind = dice.chance(0.5) ? Body::Kind::box : Body::Kind::cylinder;
    body.a = dice.between(0.4, 1.0);
    body.b = dice.between(0.4, 1.0);
    body.c = dice.between(0.1, 0.6);
    const bool is_box = body.kind == Body::Kind::box;
    const gp_Pnt at(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), is_box ? z + body.c : z);
    body.frame = gp_Ax2(at, gp::DZ());
    bodies.Append(shape_of(body));
    z += is_box ? 2.0 * body.c : body.b;
  }
  return bodies;
}

TopTools_ListOfShape bodies_apart(Dice& dice, int count)
{
  TopTools_ListOfShape bodies;
  for (int i = 0; i < count; ++i) {
    Body body = random_body(dice);
    body.frame.Translate(gp_Vec(6.0 * i, 0.0, 0.0));
    bodies.Append(shape_of(body));
  }
  return bodies;
}

TopoDS_Shape compound_of(const TopTools_ListOfShape& bodies)
{
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& body : bodies) builder.Add(compound, body);
  return compound;
}

}  // namespace

TopoDS_Shape random_sweep(Dice& dice)
{
  const double kind = dice.between(0.0, 1.0);
  return kind < 0.4 ? extruded(dice) : kind < 0.8 ? turned(dice) : lofted(dice);
}

TopoDS_Shape dressed(const TopoDS_Shape& part, Dice& dice)
{
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(part, TopAbs_EDGE, edges);
  if (edges.IsEmpty()) throw Rejected("no edge to round");
  const double kind = dice.between(0.0, 1.0);
  if (kind < 0.55) return rounded_edges(part, edges, dice);
  if (kind < 0.75) return cut_edges(part, edges, dice);
  return hollow(part, dice);
}

TopoDS_Shape random_assembly(Dice& dice)
{
  const int count = 2 + dice.below(4);
  const double kind = dice.between(0.0, 1.0);
  if (kind < 0.2) return compound_of(bodies_apart(dice, count));
  TopTools_ListOfShape bodies;
  if (kind < 0.7) {
    bodies = stacked_bodies(dice, count);
  } else {
    for (int i = 0; i < std::min(count, 3); ++i) bodies.Append(shape_of(random_body(dice)));
  }
  BRepAlgoAPI_BuilderAlgo builder;
  builder.SetArguments(bodies);
  builder.Build();
  if (!builder.IsDone() || builder.HasErrors()) throw Rejected("the bodies cannot be joined");
  return builder.Shape();
}
