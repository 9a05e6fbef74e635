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
#include <Precision.hxx>
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

Shapes edges_of(const std::string& name, const model::Polyline& line)
{
  Shapes edges;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec3& a = line.points[i - 1];
    const Vec3& b = line.points[i];
    if (norm(b - a) <= Precision::Confusion()) {
      throw GeometryError(fmt::format("[[embed]] \"{}\": points {} and {} of its polyline are one",
                                      name, i, i + 1));
    }
    edges.push_back(BRepBuilderAPI_MakeEdge(to_occ(a), to_occ(b)).Edge());
  }
  return edges;
}

// Those of the case come first: what several lines share has the name of the first.
std::vector<Candidate> candidates_of(const std::vector<TopoDS_Shape>& loose,
                                     const model::AssemblyOptions& options, const CadFile& cad)
{
  std::vector<Candidate> candidates;
  for (const auto& [name, shape] : options.embedded) {
    const auto* const line = std::get_if<model::Polyline>(&shape);
    if (line != nullptr) candidates.push_back({edges_of(name, *line), name, true});
  }
  if (options.loose_curves != model::LooseParts::embed) return candidates;
  for (const TopoDS_Shape& edge : loose) {
    if (!BRep_Tool::Degenerated(TopoDS::Edge(edge)))
      candidates.push_back({{edge}, label_in(cad.names, edge).name});
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

// Puts pieces of lines beside the solids.
class LineEmbedding {
 public:
  explicit LineEmbedding(CadFile& cad) : cad_(cad), solids_(parts_of(cad.shape, TopAbs_SOLID)) {}

  void run(const std::vector<Candidate>& candidates)
  {
    divide(candidates, solids_, splitter_);
    BRep_Builder().MakeCompound(with_lines_);
    BRep_Builder().Add(with_lines_, cad_.shape);
    for (const Candidate& candidate : candidates) add(candidate);
    if (!added_.IsEmpty()) cad_.shape = with_lines_;
    if (num_outside_ == 0) return;
    cad_.repairs.push_back(
        fmt::format("curves that lie outside of all solids were left out: {}", num_outside_));
  }

 private:
  void add(const Candidate& candidate)
  {
    model::EmbeddedLine line{.name = candidate.name};
    bool is_inside = false;
    for (const TopoDS_Shape& edge : candidate.edges) {
      for (const TopoDS_Shape& piece : images_of(edge, splitter_)) {
        if (!is_in_solid(piece)) continue;
        is_inside = true;
        if (!added_.Add(piece)) continue;
        BRep_Builder().Add(with_lines_, piece);
        ++line.num_edges;
        line.length += length_of(piece);
        if (!candidate.name.empty()) cad_.names.Bind(piece, {.name = candidate.name});
      }
    }
    if (line.num_edges > 0) {
      cad_.assembly.lines.push_back(std::move(line));
    } else if (candidate.is_asked) {
      throw GeometryError(fmt::format(
          "[[embed]] \"{}\" lies {}", candidate.name,
          is_inside ? "on other lines altogether; leave it out" : "outside of all solids"));
    } else {
      num_outside_ += is_inside ? 0 : 1;
    }
  }

  [[nodiscard]] bool is_in_solid(const TopoDS_Shape& piece) const
  {
    return std::ranges::any_of(solids_,
                               [&](const TopoDS_Shape& solid) { return lies_in(piece, solid); });
  }

  CadFile& cad_;
  Shapes solids_;
  BRepAlgoAPI_Splitter splitter_{};
  TopoDS_Compound with_lines_{};
  TopTools_MapOfShape added_{};
  int num_outside_ = 0;
};

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
  if (!candidates.empty()) LineEmbedding(cad).run(candidates);
}

}  // namespace tessera::cad
