// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/embed_lines.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "cad/heal/fuse.hpp"
#include "cad/inner_lines.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Edges to be put in, all of one name.
struct Candidate {
  Shapes edges{};
  std::string name{};
  bool is_asked = false;  // By the case.
};

Shapes edges_of(const model::Polyline& line)
{
  Shapes edges;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec3& a = line.points[i - 1];
    const Vec3& b = line.points[i];
    edges.push_back(
        BRepBuilderAPI_MakeEdge(gp_Pnt(a[0], a[1], a[2]), gp_Pnt(b[0], b[1], b[2])).Edge());
  }
  return edges;
}

std::vector<Candidate> candidates_of(const std::vector<TopoDS_Shape>& loose,
                                     const model::AssemblyOptions& options, const CadFile& cad)
{
  std::vector<Candidate> candidates;
  if (options.loose_curves == model::LooseParts::embed) {
    for (const TopoDS_Shape& edge : loose) {
      if (BRep_Tool::Degenerated(TopoDS::Edge(edge))) continue;
      candidates.push_back({{edge}, label_in(cad.names, edge).name});
    }
  }
  for (const auto& [name, shape] : options.embedded) {
    const auto* const line = std::get_if<model::Polyline>(&shape);
    if (line != nullptr) candidates.push_back({edges_of(*line), name, true});
  }
  return candidates;
}

// Divided at the faces of the solids, and at each other.
void divide(const std::vector<Candidate>& candidates, const Shapes& solids,
            BRepAlgoAPI_Splitter& splitter)
{
  TopTools_ListOfShape lines;
  TopTools_ListOfShape tools;
  for (const Candidate& candidate : candidates) {
    for (const TopoDS_Shape& edge : candidate.edges) lines.Append(edge);
  }
  for (const TopoDS_Shape& solid : solids) tools.Append(solid);
  splitter.SetArguments(lines);
  splitter.SetTools(tools);
  splitter.SetNonDestructive(Standard_True);
  splitter.SetRunParallel(Standard_False);
  splitter.Build();
  if (!splitter.HasErrors()) return;
  throw GeometryError(
      "OpenCASCADE cannot divide the lines that are to be embedded at the faces of the solids; "
      "move them a little, or set geometry.loose_curves to \"drop\" if they are the file's");
}

}  // namespace

void embed_lines(const std::vector<TopoDS_Shape>& loose, const model::AssemblyOptions& options,
                 CadFile& cad)
{
  if (!loose.empty() && options.loose_curves == model::LooseParts::drop) {
    cad.repairs.push_back(fmt::format(
        "curves that belong to no face were left out: {}; geometry.loose_curves = \"embed\" puts "
        "them into the mesh",
        loose.size()));
  }
  const std::vector<Candidate> candidates = candidates_of(loose, options, cad);
  if (candidates.empty()) return;
  const Shapes solids = parts_of(cad.shape, TopAbs_SOLID);
  BRepAlgoAPI_Splitter splitter;
  divide(candidates, solids, splitter);
  TopoDS_Compound with_lines;
  BRep_Builder builder;
  builder.MakeCompound(with_lines);
  builder.Add(with_lines, cad.shape);
  TopTools_MapOfShape added;
  for (const Candidate& candidate : candidates) {
    model::EmbeddedLine line{.name = candidate.name};
    for (const TopoDS_Shape& edge : candidate.edges) {
      for (const TopoDS_Shape& piece : images_of(edge, splitter)) {
        const bool is_inside = std::ranges::any_of(
            solids, [&](const TopoDS_Shape& solid) { return lies_in(piece, solid); });
        if (!is_inside) continue;
        ++line.num_edges;
        line.length += length_of(piece);
        if (!added.Add(piece)) continue;
        builder.Add(with_lines, piece);
        if (!candidate.name.empty()) cad.names.Bind(piece, {.name = candidate.name});
      }
    }
    if (line.num_edges > 0) {
      cad.assembly.lines.push_back(std::move(line));
    } else if (candidate.is_asked) {
      throw GeometryError(
          fmt::format("[[embed]] \"{}\" lies outside of all solids", candidate.name));
    }
  }
  if (!added.IsEmpty()) cad.shape = with_lines;
}

}  // namespace tessera::cad
