// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <BOPAlgo_BuilderFace.hxx>
#include <BOPAlgo_MakerVolume.hxx>
#include <BOPAlgo_PaveFiller.hxx>
#include <BOPDS_DS.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BOPTools_AlgoTools2D.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IntTools_Context.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_DataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <fmt/format.h>
#include <gp_Pnt.hxx>

#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"

#include "cad/error.hpp"
#include "cad/heal/glue.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Edges that are nearer lie on each other, in fractions of the solid's box diagonal. As thin is
// what counts as a film between solids.
constexpr double kNearest = 1e-6;

using Images = TopTools_DataMapOfShapeListOfShape;

struct Edge {
  TopoDS_Shape shape{};
  Bnd_Box box{};
  std::array<gp_Pnt, 2> ends{};
};

// Each that is no point, in a box that is `gap` wider.
std::vector<Edge> edges_of(const TopoDS_Shape& shape, double gap)
{
  std::vector<Edge> edges;
  for (const TopoDS_Shape& part : parts_of(shape, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(part);
    if (BRep_Tool::Degenerated(edge)) continue;
    Bnd_Box box;
    BRepBndLib::Add(edge, box, Standard_False);
    box.Enlarge(gap);
    edges.push_back(
        {edge,
         box,
         {BRep_Tool::Pnt(TopExp::FirstVertex(edge)), BRep_Tool::Pnt(TopExp::LastVertex(edge))}});
  }
  return edges;
}

// Whether a piece of both may be the same: it would end at two of their ends.
bool may_overlap(const Edge& a, const Edge& b, double gap)
{
  if (a.box.IsOut(b.box)) return false;
  const auto is_closed = [&](const Edge& edge) {
    return edge.ends[0].Distance(edge.ends[1]) < gap;
  };
  if (is_closed(a) && is_closed(b)) return true;
  std::vector<gp_Pnt> common;
  const auto add = [&](const gp_Pnt& end, const Bnd_Box& box) {
    const auto is_here = [&](const gp_Pnt& other) { return other.Distance(end) <= gap; };
    if (!box.IsOut(end) && std::ranges::none_of(common, is_here)) common.push_back(end);
  };
  for (const gp_Pnt& end : a.ends) add(end, b.box);
  for (const gp_Pnt& end : b.ends) add(end, a.box);
  return common.size() >= 2;
}

double lowest_x(const Edge& edge) { return edge.box.CornerMin().X(); }

// Edges by themselves, as parts of one argument are not compared: all that may overlap another.
TopTools_ListOfShape edges_that_may_overlap(const TopoDS_Shape& shape, double gap)
{
  std::vector<Edge> edges = edges_of(shape, gap);
  std::ranges::stable_sort(edges, {}, lowest_x);
  std::vector<bool> is_one(edges.size(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double highest_x = edges[i].box.CornerMax().X();
    for (std::size_t j = i + 1; j < edges.size() && lowest_x(edges[j]) <= highest_x; ++j) {
      if (!may_overlap(edges[i], edges[j], gap)) continue;
      is_one[i] = true;
      is_one[j] = true;
    }
  }
  TopTools_ListOfShape found;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (is_one[i]) found.Append(edges[i].shape);
  }
  return found;
}

// Pairs of pieces of edges that lie on each other from end to end.
int count_overlaps(const TopoDS_Shape& shape, double gap)
{
  BOPAlgo_PaveFiller filler;
  filler.SetArguments(edges_that_may_overlap(shape, gap));
  filler.SetNonDestructive(Standard_True);
  filler.SetRunParallel(Standard_False);
  filler.SetFuzzyValue(gap);
  filler.Perform();
  if (filler.HasErrors()) return 0;
  const BOPDS_VectorOfInterfEE& met = filler.PDS()->InterfEE();
  return static_cast<int>(std::count_if(met.begin(), met.end(), [](const BOPDS_InterfEE& pair) {
    return pair.CommonPart().Type() == TopAbs_EDGE;
  }));
}

// What becomes of edges that are cut where others lie on them.
Images pieces_of_edges(const TopoDS_Shape& solid, double gap)
{
  TopTools_ListOfShape edges;
  for (const Edge& edge : edges_of(solid, gap)) edges.Append(edge.shape);
  BRepAlgoAPI_BuilderAlgo fuse;
  fuse.SetArguments(edges);
  fuse.SetNonDestructive(Standard_True);
  fuse.SetRunParallel(Standard_False);
  fuse.SetFuzzyValue(gap);
  fuse.Build();
  Images images;
  if (fuse.HasErrors()) return images;
  for (const TopoDS_Shape& edge : edges) {
    TopTools_ListOfShape pieces = fuse.Modified(edge);
    if (pieces.IsEmpty() && !fuse.IsDeleted(edge)) pieces.Append(edge);
    images.Bind(edge, pieces);
  }
  return images;
}

// The pieces of the face's edges, each in the direction in which it bounds the face.
TopTools_ListOfShape sides_of(const TopoDS_Face& face, const Images& images)
{
  TopTools_ListOfShape sides;
  const Handle(IntTools_Context) context = new IntTools_Context;
  for (TopExp_Explorer side(face, TopAbs_EDGE); side.More(); side.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(side.Current());
    const TopTools_ListOfShape* const pieces = images.Seek(edge);
    if (pieces == nullptr) {
      sides.Append(edge);
      continue;
    }
    for (const TopoDS_Shape& piece : *pieces) {
      TopoDS_Edge part = TopoDS::Edge(piece.Oriented(edge.Orientation()));
      if (BOPTools_AlgoTools::IsSplitToReverse(part, edge, context)) part.Reverse();
      if (!BOPTools_AlgoTools2D::HasCurveOnSurface(part, face)) {
        BOPTools_AlgoTools2D::BuildPCurveForEdgeOnFace(part, face, context);
      }
      sides.Append(part);
    }
  }
  return sides;
}

// Without those that bound the face from both sides, as where a hole has come to the rim.
TopTools_ListOfShape without_slits(const TopTools_ListOfShape& sides, const TopoDS_Face& face)
{
  TopTools_DataMapOfShapeInteger num_uses;
  for (const TopoDS_Shape& side : sides) {
    if (!num_uses.IsBound(side)) num_uses.Bind(side, 0);
    ++num_uses.ChangeFind(side);
  }
  TopTools_ListOfShape kept;
  for (const TopoDS_Shape& side : sides) {
    const bool is_seam = BRep_Tool::IsClosed(TopoDS::Edge(side), face);
    if (num_uses.Find(side) == 1 || is_seam) kept.Append(side);
  }
  return kept;
}

// No face, one or more between the pieces of its edges.
TopTools_ListOfShape pieces_of_face(const TopoDS_Face& face, const Images& images)
{
  const bool is_whole = std::ranges::all_of(parts_of(face, TopAbs_EDGE), [&](const auto& edge) {
    const TopTools_ListOfShape* const pieces = images.Seek(edge);
    return pieces == nullptr || (pieces->Extent() == 1 && pieces->First().IsSame(edge));
  });
  if (is_whole) {
    TopTools_ListOfShape itself;
    itself.Append(face);
    return itself;
  }
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  BOPAlgo_BuilderFace builder;
  builder.SetFace(forward);
  builder.SetShapes(without_slits(sides_of(forward, images), forward));
  builder.Perform();
  return builder.Areas();
}

// What becomes of the edges and faces of a solid; nothing if that fails.
Images cut_at_overlaps(const TopoDS_Shape& solid, double gap)
{
  Images images = pieces_of_edges(solid, gap);
  if (images.IsEmpty()) return images;
  for (const TopoDS_Shape& face : parts_of(solid, TopAbs_FACE)) {
    images.Bind(face, pieces_of_face(TopoDS::Face(face), images));
  }
  return images;
}

// The one of the bodies between these faces that is the solid; null if none is.
TopoDS_Shape body_like(const TopoDS_Shape& solid, const Images& images, double gap)
{
  TopTools_ListOfShape faces;
  for (const TopoDS_Shape& face : parts_of(solid, TopAbs_FACE)) {
    const TopTools_ListOfShape* const pieces = images.Seek(face);
    if (pieces == nullptr) return {};
    for (const TopoDS_Shape& piece : *pieces) faces.Append(piece);
  }
  BOPAlgo_MakerVolume maker;
  maker.SetArguments(faces);
  maker.SetIntersect(false);
  maker.SetAvoidInternalShapes(true);
  maker.SetNonDestructive(Standard_True);
  maker.SetRunParallel(Standard_False);
  maker.Perform();
  if (maker.HasErrors()) return {};
  const std::size_t num_shells = parts_of(solid, TopAbs_SHELL).size();
  for (const TopoDS_Shape& body : parts_of(maker.Shape(), TopAbs_SOLID)) {
    if (is_closed(body) && parts_of(body, TopAbs_SHELL).size() == num_shells
        && std::abs(volume_of(body) - volume_of(solid)) <= gap * area_of(solid)
        && BRepCheck_Analyzer(body).IsValid() && count_overlaps(body, gap) == 0) {
      return body;
    }
  }
  return {};
}

}  // namespace

TopoDS_Shape without_overlaps(const TopoDS_Shape& solid, CadFile& cad)
{
  if (is_left_out(Repair::overlapping_edges)) return solid;
  const double gap = kNearest * box_diagonal_of(solid);
  try {
    const int num_overlaps = count_overlaps(solid, gap);
    if (num_overlaps == 0) return solid;
    const Images images = cut_at_overlaps(solid, gap);
    const TopoDS_Shape body = body_like(solid, images, gap);
    const std::string found = fmt::format("edges of a solid lay on each other ({}x)", num_overlaps);
    if (body.IsNull()) {
      cad.repairs.push_back(found + " and could not be made one: left as is");
      return solid;
    }
    follow_names(solid, cad.names, [&](const TopoDS_Shape& part) {
      TopTools_ListOfShape pieces;
      if (part.IsSame(solid)) pieces.Append(body);
      if (const TopTools_ListOfShape* const cut = images.Seek(part)) pieces = *cut;
      return pieces;
    });
    note_repair(Repair::overlapping_edges, num_overlaps);
    cad.repairs.push_back(found + " and were made one");
    return body;
  } catch (const Standard_Failure& failure) {
    note_given_up("edges of a solid that lie on each other made one", error_of(failure));
    return solid;
  }
}

}  // namespace tessera::cad
