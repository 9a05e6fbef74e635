// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_Wireframe.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"

#include "cad/cad_file.hpp"
#include "cad/heal/embed.hpp"
#include "cad/heal/embed_lines.hpp"
#include "cad/heal/glue.hpp"
#include "cad/heal/overlaps.hpp"
#include "cad/heal/periods.hpp"
#include "cad/inner_lines.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Sewing gaps that are tried, in fractions of the box diagonal; a wider gap is no rounding.
constexpr std::array<double, 4> kSewingGaps{1e-6, 1e-5, 1e-4, 1e-3};

std::string counted(int number, const std::string& thing)
{
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

// "3 shells, 120 faces": what a file without a solid holds.
std::string contents_of(const TopoDS_Shape& shape)
{
  std::string text;
  const std::array<std::pair<TopAbs_ShapeEnum, const char*>, 4> kinds{{{TopAbs_SHELL, "shell"},
                                                                       {TopAbs_FACE, "face"},
                                                                       {TopAbs_EDGE, "edge"},
                                                                       {TopAbs_VERTEX, "point"}}};
  for (const auto& [kind, name] : kinds) {
    const int number = count_of(shape, kind);
    if (number == 0) continue;
    text += (text.empty() ? "" : ", ") + counted(number, name);
    if (kind == TopAbs_FACE) break;
  }
  return text.empty() ? "nothing" : text;
}

struct Sewn {
  std::vector<TopoDS_Shape> closed_shells{};
  int num_open_shells = 0;
  int num_open_edges = 0;
  double gap = 0.0;
  std::string first_open_edge{};  // Where it is.
};

std::string place_of(const TopoDS_Edge& edge)
{
  const gp_Pnt point = BRep_Tool::Pnt(TopExp::FirstVertex(edge));
  return fmt::format("({:g}, {:g}, {:g})", point.X(), point.Y(), point.Z());
}

Sewn sew(const TopoDS_Shape& faces, double gap, ShapeNames& names)
{
  BRepBuilderAPI_Sewing sewing(gap);
  sewing.Add(faces);
  sewing.Perform();
  Sewn sewn;
  sewn.gap = gap;
  sewn.num_open_edges = sewing.NbFreeEdges();
  if (sewn.num_open_edges > 0) sewn.first_open_edge = place_of(sewing.FreeEdge(1));
  for (const TopoDS_Shape& shell : parts_of(sewing.SewedShape(), TopAbs_SHELL)) {
    if (BRep_Tool::IsClosed(shell)) {
      sewn.closed_shells.push_back(shell);
    } else {
      ++sewn.num_open_shells;
    }
  }
  follow_names(faces, names, [&](const TopoDS_Shape& face) {
    TopTools_ListOfShape images;
    images.Append(sewing.IsModifiedSubShape(face) ? sewing.ModifiedSubShape(face) : face);
    return images;
  });
  return sewn;
}

// Sews with the narrowest gap that closes everything; else the one that leaves fewest open edges.
Sewn sew(const TopoDS_Shape& faces, ShapeNames& names)
{
  const double diagonal = box_diagonal_of(faces);
  Sewn best;
  for (const double gap : kSewingGaps) {
    Sewn sewn = sew(faces, gap * diagonal, names);
    const bool first = best.gap == 0.0;
    if (first || sewn.num_open_edges < best.num_open_edges) best = std::move(sewn);
    if (best.num_open_edges == 0) break;
  }
  return best;
}

std::vector<TopoDS_Shape> solids_from_faces(const TopoDS_Shape& faces, CadFile& cad)
{
  if (is_left_out(Repair::sewn_faces)) throw GeometryError("faces are not to be sewn");
  const Sewn sewn = sew(faces, cad.names);
  if (sewn.closed_shells.empty()) {
    throw GeometryError(
        fmt::format("no closed solid: sewn with gap {:g}, {} of {} bound one face only, the first "
                    "at {}; close the gaps in the CAD program",
                    sewn.gap, counted(sewn.num_open_edges, "edge"),
                    counted(count_of(faces, TopAbs_FACE), "face"), sewn.first_open_edge));
  }
  std::vector<TopoDS_Shape> solids;
  for (const TopoDS_Shape& shell : sewn.closed_shells) {
    solids.push_back(BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell)).Solid());
  }
  note_repair(Repair::sewn_faces, static_cast<GlobalIndex>(solids.size()));
  std::string line =
      fmt::format("sewed {} with gap {:g} into {}", counted(count_of(faces, TopAbs_FACE), "face"),
                  sewn.gap, counted(static_cast<int>(solids.size()), "solid"));
  if (sewn.num_open_shells > 0) {
    line += fmt::format("; left out {}", counted(sewn.num_open_shells, "open shell"));
  }
  cad.repairs.push_back(std::move(line));
  return solids;
}

void follow_names(const TopoDS_Shape& shape, ShapeBuild_ReShape& changes, ShapeNames& names)
{
  follow_names(shape, names, [&](const TopoDS_Shape& part) {
    TopTools_ListOfShape images;
    images.Append(changes.Apply(part));
    return images;
  });
}

// ShapeFix on wires, faces, shells and the solid, then on small edges and gaps in wires.
TopoDS_Shape fixed(const TopoDS_Shape& solid, ShapeNames& names)
{
  const Handle(ShapeBuild_ReShape) changes = new ShapeBuild_ReShape;
  ShapeFix_Shape shape_fix(solid);
  shape_fix.SetContext(changes);
  shape_fix.Perform();
  ShapeFix_Wireframe wires(shape_fix.Shape());
  wires.SetContext(changes);
  wires.ModeDropSmallEdges() = Standard_True;
  wires.FixSmallEdges();
  wires.FixWireGaps();
  follow_names(solid, *changes, names);
  return wires.Shape();
}

// The solid with wires that close in the parameters of their faces.
TopoDS_Shape closed_in_parameters(const TopoDS_Shape& solid, ShapeNames& names)
{
  if (is_left_out(Repair::closed_wires)) return solid;
  const Handle(ShapeBuild_ReShape) changes = new ShapeBuild_ReShape;
  TopoDS_Shape better = with_closed_wires(solid, *changes);
  follow_names(solid, *changes, names);
  return better;
}

bool is_valid_and_closed(const TopoDS_Shape& solid)
{
  return BRepCheck_Analyzer(solid).IsValid() && is_closed(solid);
}

bool is_sound(const TopoDS_Shape& solid)
{
  return is_valid_and_closed(solid) && !has_false_points(solid);
}

// One solid of the file as closed solids; usually itself.
std::vector<TopoDS_Shape> healed(const TopoDS_Shape& given, int number, CadFile& cad)
{
  const std::string name = fmt::format("solid {}", number);
  if (is_sound(given)) return {given};
  const TopoDS_Shape solid = closed_in_parameters(given, cad.names);
  if (is_sound(solid)) {
    note_repair(Repair::closed_wires);
    cad.repairs.push_back(name + " had wires that did not close on periodic faces; they do now");
    return {solid};
  }
  if (is_left_out(Repair::fixed_shapes)) return {solid};
  const TopoDS_Shape better = fixed(solid, cad.names);
  std::vector<TopoDS_Shape> closed;
  for (const TopoDS_Shape& part : parts_of(better, TopAbs_SOLID)) {
    if (is_closed(part)) closed.push_back(part);
  }
  const bool clean = !closed.empty() && std::ranges::all_of(closed, is_valid_and_closed);
  if (!clean && is_valid_and_closed(given)) return {given};
  const std::string was = is_closed(solid) ? "was invalid" : "was not closed";
  if (closed.empty() && is_closed(solid)) {
    cad.repairs.push_back(name + " is closed but invalid, and fixing it made it worse: left as is");
    return {solid};
  }
  if (closed.empty()) {
    cad.repairs.push_back(fmt::format("{} {}", name, was));
    return solids_from_faces(count_of(better, TopAbs_FACE) > 0 ? better : solid, cad);
  }
  note_repair(Repair::fixed_shapes);
  cad.repairs.push_back(fmt::format("{} {}; its wires, faces and shells were fixed{}", name, was,
                                    clean ? "" : ", defects remain"));
  return closed;
}

// Of the only solid triangles tell it, unless they are farther off its faces than these are apart:
// the model's figures are made of them later. Several are fused first, by boxes of triangles if
// there are some.
bool has_volume(const TopoDS_Shape& solid, bool is_only)
{
  if (!is_only) return volume_of(solid) > 0.0;
  const RoughFigures rough = rough_figures_of(solid, box_diagonal_of(solid));
  const bool is_sure = std::abs(rough.volume) > rough.deflection * rough.area;
  return (is_sure ? rough.volume : volume_of(solid)) > 0.0;
}

// A solid that is the outside of what was meant turns inside out.
TopoDS_Shape outward(const TopoDS_Shape& shape, bool is_only, CadFile& cad)
{
  TopoDS_Solid solid = TopoDS::Solid(shape);
  if (is_left_out(Repair::turned_solids) || has_volume(solid, is_only)) return solid;
  BRepLib::OrientClosedSolid(solid);
  if (volume_of(solid) < 0.0) solid = TopoDS::Solid(solid.Reversed());
  note_repair(Repair::turned_solids);
  cad.repairs.emplace_back("a solid was inside out and was turned");
  return solid;
}

void require_curves(const TopoDS_Shape& shape)
{
  BRepLib::BuildCurves3d(shape);
  for (const TopoDS_Shape& part : parts_of(shape, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(part);
    double first = 0.0;
    double last = 0.0;
    if (BRep_Tool::Degenerated(edge)) continue;
    if (BRep_Tool::Curve(edge, first, last).IsNull()) {
      throw GeometryError(fmt::format("the edge at {} has no curve in space", place_of(edge)));
    }
  }
}

// One part of an assembly, placed twice at the same place, is one solid.
void tell_of_doubles(CadFile& cad, std::size_t num_different)
{
  std::size_t num_placed = 0;
  for (TopExp_Explorer each(cad.shape, TopAbs_SOLID); each.More(); each.Next()) ++num_placed;
  if (num_placed == num_different) return;
  cad.repairs.push_back(
      fmt::format("solids that the file has twice at the same place were taken "
                  "once: {} were left out",
                  num_placed - num_different));
}

std::vector<TopoDS_Shape> closed_solids(CadFile& cad)
{
  std::vector<TopoDS_Shape> given = parts_of(cad.shape, TopAbs_SOLID);
  tell_of_doubles(cad, given.size());
  const auto num_empty = std::erase_if(
      given, [](const TopoDS_Shape& solid) { return count_of(solid, TopAbs_FACE) == 0; });
  if (num_empty > 0) cad.repairs.emplace_back("solids without faces were left out");
  if (given.empty()) {
    if (count_of(cad.shape, TopAbs_FACE) == 0) {
      throw GeometryError(fmt::format(
          "no solid and no face to make one of; the file holds {}: export the model as a solid",
          contents_of(cad.shape)));
    }
    try {
      return solids_from_faces(cad.shape, cad);
    } catch (const GeometryError& error) {
      throw GeometryError(
          fmt::format("no solid, only {}; {}", contents_of(cad.shape), error.what()));
    }
  }
  std::vector<TopoDS_Shape> solids;
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const TopoDS_Shape& solid : healed(given[i], static_cast<int>(i) + 1, cad)) {
      solids.push_back(solid);
    }
  }
  return solids;
}

// Those beside solids; of a file without solids none, as all are sewn.
std::vector<TopoDS_Shape> loose_faces_of(const TopoDS_Shape& shape)
{
  std::vector<TopoDS_Shape> loose;
  if (count_of(shape, TopAbs_SOLID) == 0) return loose;
  for (TopExp_Explorer faces(shape, TopAbs_FACE, TopAbs_SOLID); faces.More(); faces.Next()) {
    loose.push_back(faces.Current());
  }
  return loose;
}

std::vector<TopoDS_Shape> loose_curves_of(const TopoDS_Shape& shape)
{
  return count_of(shape, TopAbs_SOLID) == 0 ? std::vector<TopoDS_Shape>{} : inner_lines_of(shape);
}

}  // namespace

void make_closed_solids(CadFile& cad, const model::AssemblyOptions& options)
{
  const std::vector<TopoDS_Shape> loose_faces = loose_faces_of(cad.shape);
  const std::vector<TopoDS_Shape> loose_curves = loose_curves_of(cad.shape);
  std::vector<TopoDS_Shape> solids = closed_solids(cad);
  const bool is_only = solids.size() == 1;
  for (TopoDS_Shape& solid : solids) solid = without_overlaps(outward(solid, is_only, cad), cad);
  cad.shape = solids.size() == 1 ? solids.front() : glued(solids, options, cad);
  embed_faces(loose_faces, options, cad);
  embed_lines(loose_curves, options, cad);
  for (TopExp_Explorer parts(cad.shape, TopAbs_SOLID); parts.More(); parts.Next()) {
    if (!is_closed(parts.Current())) {
      throw GeometryError(
          "a solid is not closed, also after healing; repair it in the CAD program");
    }
  }
  require_curves(cad.shape);
}

}  // namespace tessera::cad
