// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/cad/assemblies.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>

namespace tessera::testing {
namespace {

constexpr double kPi = std::numbers::pi;

Body box(const std::string& name, const gp_Pnt& low, double x, double y, double z)
{
  return {name, BRepPrimAPI_MakeBox(low, x, y, z).Shape(), x * y * z};
}

Body moved(const Body& body, const std::string& name, const gp_Vec& by)
{
  gp_Trsf move;
  move.SetTranslation(by);
  return {name, body.solid.Moved(TopLoc_Location(move)), body.volume};
}

Body pin(double radius)
{
  const gp_Ax2 axis(gp_Pnt(0, 0, -0.5), gp::DZ());
  return {"pin", BRepPrimAPI_MakeCylinder(axis, radius, 2.0).Shape(), kPi * radius * radius * 2.0};
}

// With a hole of radius 0.7.
Body plate()
{
  const TopoDS_Shape whole = BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, 0), 4, 4, 1).Shape();
  return {"plate", BRepAlgoAPI_Cut(whole, pin(0.7).solid).Shape(), 16.0 - kPi * 0.49};
}

Body ball(const std::string& name, const gp_Pnt& centre, double radius)
{
  return {name, BRepPrimAPI_MakeSphere(centre, radius).Shape(),
          4.0 / 3.0 * kPi * radius * radius * radius};
}

// Of a body that is another one moved, STEP would have an assembly.
TopoDS_Shape as_part_of_its_own(const TopoDS_Shape& solid)
{
  const gp_Trsf place = solid.Location().Transformation();
  return BRepBuilderAPI_Transform(solid.Located(TopLoc_Location()), place, Standard_True).Shape();
}

AssemblyModel ball_in_block()
{
  const Body inner = ball("ball", gp_Pnt(2, 2, 2), 1.0);
  const Body block = box("block", gp_Pnt(0, 0, 0), 4, 4, 4);
  const Body shell{"shell", BRepAlgoAPI_Cut(block.solid, inner.solid).Shape(),
                   block.volume - inner.volume};
  return {"ball_in_block", {inner, shell}, {{{1, 2}, 4.0 * kPi}}};
}

AssemblyModel stairs()
{
  const Body step = box("step 1", gp_Pnt(0, 0, 0), 1, 1, 1);
  AssemblyModel model{"stairs", {step}};
  for (int i = 1; i < 4; ++i) {
    model.bodies.push_back(moved(step, "step " + std::to_string(i + 1), gp_Vec(i, 0.0, 0.25 * i)));
    model.touches.push_back({{i, i + 1}, 0.75});
  }
  return model;
}

TopoDS_Shape polygon(const std::vector<gp_Pnt>& corners)
{
  BRepBuilderAPI_MakePolygon sides;
  for (const gp_Pnt& corner : corners) sides.Add(corner);
  sides.Close();
  return BRepBuilderAPI_MakeFace(sides.Wire(), Standard_True).Shape();
}

// A block of size 1, one face of which goes on upwards as a flap: two faces, one on the other.
Body lead()
{
  BRepBuilderAPI_Sewing sewing;
  for (const TopoDS_Shape& face :
       {polygon({{3, 1, 0}, {3, 2, 0}, {4, 2, 0}, {4, 1, 0}}),
        polygon({{3, 1, 1}, {4, 1, 1}, {4, 2, 1}, {3, 2, 1}}),
        polygon({{3, 1, 0}, {3, 1, 1}, {3, 2, 1}, {3, 2, 0}}),
        polygon({{3, 1, 0}, {4, 1, 0}, {4, 1, 1}, {3, 1, 1}}),
        polygon({{3, 2, 0}, {3, 2, 1}, {4, 2, 1}, {4, 2, 0}}),
        polygon({{4, 1, 0}, {4, 2, 0}, {4, 2, 1}, {4, 2, 2}, {4, 1, 2}, {4, 1, 1}}),
        polygon({{4, 1, 1}, {4, 1, 2}, {4, 2, 2}, {4, 2, 1}})}) {
    sewing.Add(face);
  }
  sewing.Perform();
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return {"lead", solid, 1.0};
}

std::vector<AssemblyModel> touching()
{
  return {
      {"offset_boxes",
       {box("low", gp_Pnt(0, 0, 0), 2, 2, 1), box("high", gp_Pnt(1, 1, 1), 2, 2, 1)},
       {{{1, 2}, 1.0}}},
      {"pin_in_hole", {plate(), pin(0.7)}, {{{1, 2}, 2.0 * kPi * 0.7}}},
      ball_in_block(),
      stairs(),
      {"boxes_at_edge",
       {box("a", gp_Pnt(0, 0, 0), 1, 1, 1), box("b", gp_Pnt(1, 0, 0), 1, 1, 1),
        box("c", gp_Pnt(0, 1, 0), 2, 1, 1)},
       {{{1, 2}, 1.0}, {{1, 3}, 1.0}, {{2, 3}, 1.0}}},
      {"four_boxes",
       {box("a", gp_Pnt(0, 0, 0), 1, 1, 1), box("b", gp_Pnt(1, 0, 0), 1, 1, 1),
        box("c", gp_Pnt(0, 1, 0), 1, 1, 1), box("d", gp_Pnt(1, 1, 0), 1, 1, 1)},
       {{{1, 2}, 1.0}, {{1, 3}, 1.0}, {{2, 4}, 1.0}, {{3, 4}, 1.0}}},
      {"boxes_on_plate",
       {box("plate", gp_Pnt(0, 0, 0), 5, 2, 0.5), box("left", gp_Pnt(0.5, 0.5, 0.5), 1, 1, 1),
        box("right", gp_Pnt(3, 0.5, 0.5), 1, 1, 1)},
       {{{1, 2}, 1.0}, {{1, 3}, 1.0}}},
      {"cylinders", {pin(0.7), moved(pin(0.4), "thin", gp_Vec(0.1, 0, 2))}, {{{1, 2}, kPi * 0.16}}},
      {"boxes_at_line",
       {box("a", gp_Pnt(0, 0, 0), 1, 1, 1), box("b", gp_Pnt(1, 1, 0), 1, 1, 1)},
       {}},
      {"lead_with_flap", {box("block", gp_Pnt(0, 0, 1), 4, 4, 2), lead()}, {{{1, 2}, 1.0}}},
      {"apart", {box("a", gp_Pnt(0, 0, 0), 1, 1, 1), box("b", gp_Pnt(2, 0, 0), 1, 1, 1)}, {}},
  };
}

std::vector<AssemblyModel> overlapping()
{
  return {
      {"overlapping_corners",
       {box("one", gp_Pnt(0, 0, 0), 2, 2, 2), box("two", gp_Pnt(1, 1, 1), 2, 2, 2)},
       {},
       {{{1, 2}, 1.0}}},
      {"pin_through_plate",
       {box("plate", gp_Pnt(-2, -2, 0), 4, 4, 1), pin(0.7)},
       {},
       {{{1, 2}, kPi * 0.49}}},
      {"inclusion",
       {box("matrix", gp_Pnt(0, 0, 0), 4, 4, 4), ball("grain", gp_Pnt(2, 2, 2), 1.0)},
       {},
       {{{1, 2}, 4.0 / 3.0 * kPi}}},
      {"twice",
       {box("one", gp_Pnt(0, 0, 0), 1, 1, 1), box("same", gp_Pnt(0, 0, 0), 1, 1, 1)},
       {},
       {{{1, 2}, 1.0}}},
      {"three_overlaps",
       {box("one", gp_Pnt(0, 0, 0), 2, 2, 2), box("two", gp_Pnt(1, 0, 0), 2, 2, 2),
        box("three", gp_Pnt(0.5, 1, 0), 2, 2, 2)},
       {},
       {{{1, 2}, 4.0}, {{1, 3}, 3.0}, {{2, 3}, 3.0}}},
  };
}

}  // namespace

std::vector<AssemblyModel> assemblies()
{
  std::vector<AssemblyModel> all = touching();
  for (AssemblyModel& model : overlapping()) all.push_back(std::move(model));
  return all;
}

AssemblyModel assembly(const std::string& name)
{
  const std::vector<AssemblyModel> all = assemblies();
  const auto found = std::ranges::find(all, name, &AssemblyModel::name);
  if (found == all.end()) throw std::runtime_error("no assembly " + name);
  return *found;
}

AssemblyModel boxes_with_gap(double gap)
{
  return {"boxes_with_gap",
          {box("low", gp_Pnt(0, 0, 0), 1, 1, 1), box("high", gp_Pnt(0.2, 0.2, 1.0 + gap), 1, 1, 1)},
          {{{1, 2}, 0.64}}};
}

TopoDS_Shape compound_of(const AssemblyModel& model)
{
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  for (const Body& body : model.bodies) BRep_Builder().Add(compound, body.solid);
  return compound;
}

void write_step(const AssemblyModel& model, const std::filesystem::path& file)
{
  const Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  double hue = 0.0;
  for (const Body& body : model.bodies) {
    const TDF_Label label = shapes->AddShape(as_part_of_its_own(body.solid), Standard_False);
    TDataStd_Name::Set(label, body.name.c_str());
    colours->SetColor(label, Quantity_Color(hue += 40.0, 0.5, 1.0, Quantity_TOC_HLS),
                      XCAFDoc_ColorSurf);
  }
  STEPCAFControl_Writer writer;
  writer.SetNameMode(Standard_True);
  writer.SetColorMode(Standard_True);
  if (!writer.Transfer(document) || writer.Write(file.c_str()) != IFSelect_RetDone) {
    throw std::runtime_error(file.string() + " cannot be written");
  }
}

}  // namespace tessera::testing
