// SPDX-License-Identifier: BSD-3-Clause
#include "cad/inner_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"

#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

gp_Pnt middle_of(const TopoDS_Shape& edge)
{
  const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
  return curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
}

// Of length 1, at a parameter between the ends of an edge, 0 to 1.
Vec3 tangent_of(const TopoDS_Shape& edge, double at)
{
  const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
  gp_Pnt point;
  gp_Vec tangent;
  curve.D1(curve.FirstParameter() + at * (curve.LastParameter() - curve.FirstParameter()), point,
           tangent);
  const Vec3 along = from_occ(tangent.XYZ());
  return (1.0 / norm(along)) * along;
}

std::vector<Vec3> tangents_of(const std::vector<TopoDS_Shape>& lines)
{
  constexpr int kOfAnEdge = 8;
  std::vector<Vec3> tangents;
  for (const TopoDS_Shape& line : lines) {
    for (int i = 0; i <= kOfAnEdge; ++i) {
      tangents.push_back(tangent_of(line, static_cast<double>(i) / kOfAnEdge));
    }
  }
  return tangents;
}

// Axes come first, then what lies between two or three of them.
std::vector<Vec3> sweeps()
{
  std::vector<Vec3> all{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3& between :
       {Vec3{1, 1, 0}, Vec3{1, -1, 0}, Vec3{1, 0, 1}, Vec3{1, 0, -1}, Vec3{0, 1, 1}, Vec3{0, 1, -1},
        Vec3{1, 1, 1}, Vec3{1, 1, -1}, Vec3{1, -1, 1}, Vec3{-1, 1, 1}}) {
    all.push_back((1.0 / norm(between)) * between);
  }
  return all;
}

// The ends of lines go on straight, out of everything that is smaller than `reach`.
TopoDS_Compound continued(const std::vector<TopoDS_Shape>& lines, double reach)
{
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& line : lines) builder.Add(all, line);
  TopTools_IndexedDataMapOfShapeListOfShape lines_at;
  TopExp::MapShapesAndAncestors(all, TopAbs_VERTEX, TopAbs_EDGE, lines_at);
  for (int v = 1; v <= lines_at.Extent(); ++v) {
    if (lines_at(v).Extent() > 1) continue;
    const TopoDS_Vertex end = TopoDS::Vertex(lines_at.FindKey(v));
    const TopoDS_Edge& line = TopoDS::Edge(lines_at(v).First());
    if (BRep_Tool::IsClosed(line)) continue;
    const bool is_first = BRep_Tool::Parameter(end, line) < BRepAdaptor_Curve(line).LastParameter();
    const Vec3 onwards = is_first ? -1.0 * tangent_of(line, 0.0) : tangent_of(line, 1.0);
    const Vec3 far = from_occ(BRep_Tool::Pnt(end)) + reach * onwards;
    const TopoDS_Vertex beyond = BRepBuilderAPI_MakeVertex(to_occ(far));
    builder.Add(all, BRepBuilderAPI_MakeEdge(end, beyond).Edge());
  }
  return all;
}

}  // namespace

std::vector<TopoDS_Shape> inner_lines_of(const TopoDS_Shape& shape)
{
  TopTools_IndexedMapOfShape seen;  // Also the edges of faces: a file may have one of them again.
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    TopExp::MapShapes(faces.Current(), TopAbs_EDGE, seen);
  std::vector<TopoDS_Shape> lines;
  for (TopExp_Explorer edges(shape, TopAbs_EDGE, TopAbs_FACE); edges.More(); edges.Next()) {
    const int before = seen.Extent();
    if (seen.Add(edges.Current()) > before) lines.push_back(edges.Current());
  }
  return lines;
}

bool lies_in(const TopoDS_Shape& edge, const TopoDS_Shape& solid)
{
  BRepClass3d_SolidClassifier classifier(solid);
  classifier.Perform(middle_of(edge), Precision::Confusion());
  return classifier.State() == TopAbs_IN || classifier.State() == TopAbs_ON;
}

Vec3 sweep_of(const std::vector<TopoDS_Shape>& lines)
{
  constexpr double kAxesFirst = 1.25;  // Walls along the sides of a box leave no sharp corners.
  constexpr double kLeast = 0.05;      // Sine of the angle to a line.
  const std::vector<Vec3> tangents = tangents_of(lines);
  const std::vector<Vec3> all = sweeps();
  Vec3 best = all.front();
  double best_sine = -1.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    double sine = 1.0;
    for (const Vec3& tangent : tangents) sine = std::min(sine, norm(cross(tangent, all[i])));
    if (sine <= (i < 3 ? best_sine : kAxesFirst * best_sine)) continue;
    best = all[i];
    best_sine = sine;
  }
  if (best_sine >= kLeast) return best;
  throw NetgenError(fmt::format(
      "the lines inside of solids go in so many directions, near ({:g}) and elsewhere, that no "
      "direction is across all of them; make each an [[embed]] of a case of its own, or leave "
      "some out",
      fmt::join(from_occ(middle_of(lines.front())), ", ")));
}

void append_curtains(const std::vector<TopoDS_Shape>& lines, const Vec3& sweep,
                     const TopoDS_Shape& solid, TopTools_ListOfShape& tools)
{
  std::vector<TopoDS_Shape> inside = lines;
  std::erase_if(inside, [&](const TopoDS_Shape& line) { return !lies_in(line, solid); });
  if (inside.empty()) return;
  const double reach = box_diagonal_of(solid);
  const TopoDS_Compound all = continued(inside, reach);
  for (const double side : {reach, -reach}) {
    const gp_Vec way(side * sweep[0], side * sweep[1], side * sweep[2]);
    const TopoDS_Shape curtain = BRepPrimAPI_MakePrism(all, way).Shape();
    for (const TopoDS_Shape& face : parts_of(curtain, TopAbs_FACE)) tools.Append(face);
  }
}

void require_lines(const CutShape& cells, const TopoDS_Shape& shape)
{
  constexpr double kMostMissing = 1e-6;  // Of its length.
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  std::vector<double> found(static_cast<std::size_t>(edges.Extent()), 0.0);
  for (const TopoDS_Shape& piece : parts_of(cells.shape, TopAbs_EDGE)) {
    const LocalIndex number = CutShape::number_in(cells.edges, piece);
    if (number != kNoIndex) found[at(number)] += length_of(piece);
  }
  for (const TopoDS_Shape& line : inner_lines_of(shape)) {
    const double length = length_of(line);
    if (found[at(edges.FindIndex(line) - 1)] >= (1.0 - kMostMissing) * length) continue;
    throw NetgenError(fmt::format("OpenCASCADE does not put the line near ({:g}) into its solid",
                                  fmt::join(from_occ(middle_of(line)), ", ")));
  }
}

}  // namespace tessera::cad
