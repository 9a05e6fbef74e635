// SPDX-License-Identifier: BSD-3-Clause
#include "cad/description.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "cad/inner_faces.hpp"
#include "cad/shape.hpp"
#include "cad/triangles/triangulation.hpp"

namespace tessera::cad {
namespace {

// How far triangles that are only looked at may be off, in parts of the box diagonal.
constexpr double kDeflection = 1e-3;
constexpr double kAngle_rad = 0.3;

// A face that cannot be triangulated is not drawn, and is in the list all the same.
void add_triangles(const TopoDS_Face& face, LocalIndex row, model::ModelDescription& to)
{
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  if (mesh.IsNull()) return;
  const bool is_turned =
      (face.Orientation() == TopAbs_REVERSED) != place.Transformation().IsNegative();
  const auto first = static_cast<LocalIndex>(to.vertex_xyz.size() / 3);
  for (int n = 1; n <= mesh->NbNodes(); ++n) {
    const gp_Pnt point = mesh->Node(n).Transformed(place);
    to.vertex_xyz.insert(to.vertex_xyz.end(), {point.X(), point.Y(), point.Z()});
  }
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    int a = 0;
    int b = 0;
    int c = 0;
    mesh->Triangle(t).Get(a, b, c);
    if (is_turned) std::swap(b, c);
    to.triangle_vertices.insert(to.triangle_vertices.end(),
                                {first + a - 1, first + b - 1, first + c - 1});
    to.triangle_face.push_back(row);
  }
}

// Bodies: one may be several solids, which faces inside of it part.
void add_solids(const OccContent& content, model::ModelDescription& to)
{
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(content.shape, TopAbs_FACE, faces);
  const TopTools_MapOfShape inside = faces_inside_of_bodies(content.shape, content.solid_body);
  std::size_t row = 0;
  for (TopExp_Explorer solids(content.shape, TopAbs_SOLID); solids.More(); solids.Next(), ++row) {
    const LocalIndex number = content.solid_body.at(row);
    if (to.solids.size() < at(number)) to.solids.push_back({content.solid_names.at(row)});
    to.solids[at(number - 1)].volume += volume_of(solids.Current());
    for (const TopoDS_Shape& face : parts_of(solids.Current(), TopAbs_FACE)) {
      model::FaceDescription& described =
          to.faces[static_cast<std::size_t>(faces.FindIndex(face)) - 1];
      described.is_inside = inside.Contains(face);
      const bool is_known = !described.solids.empty() && described.solids.back() == number;
      if (!is_known) described.solids.push_back(number);
    }
  }
}

// By the nodes that the triangles of a face have on it.
void add_lines(const TopoDS_Edge& edge, model::EdgeDescription& to)
{
  Handle(Poly_PolygonOnTriangulation) polygon;
  Handle(Poly_Triangulation) mesh;
  TopLoc_Location place;
  BRep_Tool::PolygonOnTriangulation(edge, polygon, mesh, place);
  if (polygon.IsNull() || mesh.IsNull()) return;
  const auto node = [&](int i) {
    const gp_Pnt point = mesh->Node(polygon->Node(i)).Transformed(place);
    return Vec3{point.X(), point.Y(), point.Z()};
  };
  for (int i = 2; i <= polygon->NbNodes(); ++i) to.draw_line(node(i - 1), node(i));
}

// Rows of the faces around each edge, by its number.
std::vector<std::vector<LocalIndex>> faces_of_edges(const TopoDS_Shape& shape)
{
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  std::vector<std::vector<LocalIndex>> faces(static_cast<std::size_t>(edges.Extent()));
  LocalIndex row = 0;
  for (const TopoDS_Shape& face : parts_of(shape, TopAbs_FACE)) {
    for (const TopoDS_Shape& edge : parts_of(face, TopAbs_EDGE)) {
      faces[static_cast<std::size_t>(edges.FindIndex(edge)) - 1].push_back(row);
    }
    ++row;
  }
  return faces;
}

// Edges that are points keep their numbers, and are not in the list.
void add_edges(const OccContent& content, model::ModelDescription& to)
{
  std::size_t row = 0;
  const std::vector<std::vector<LocalIndex>> faces = faces_of_edges(content.shape);
  for (const TopoDS_Shape& shape : parts_of(content.shape, TopAbs_EDGE)) {
    const std::size_t here = row++;
    const TopoDS_Edge& edge = TopoDS::Edge(shape);
    if (BRep_Tool::Degenerated(edge)) continue;
    Bnd_Box box;
    BRepBndLib::AddOptimal(edge, box, Standard_False, Standard_False);
    const gp_Pnt low = box.CornerMin();
    const gp_Pnt high = box.CornerMax();
    to.edges.push_back({.number = std::to_string(here + 1),
                        .name = content.edge_names.at(here),
                        .length = length_of(edge),
                        .low = {low.X(), low.Y(), low.Z()},
                        .high = {high.X(), high.Y(), high.Z()},
                        .faces = faces[here]});
    add_lines(edge, to.edges.back());
  }
}

}  // namespace

model::ModelDescription describe_shape(const OccContent& content)
{
  model::ModelDescription described;
  IMeshTools_Parameters parameters;
  parameters.Deflection = kDeflection * box_diagonal_of(content.shape);
  parameters.Angle = kAngle_rad;
  static_cast<void>(triangulate_faces(content.shape, parameters));
  for (const TopoDS_Shape& face : parts_of(content.shape, TopAbs_FACE)) {
    const auto row = described.faces.size();
    const LocalIndex number = static_cast<LocalIndex>(row) + 1;
    described.faces.push_back(
        {.number = number,
         .piece_of = content.given_face.empty() ? kNoIndex : content.given_face.at(row),
         .name = content.face_names.at(row),
         .colour = content.face_colours.at(row),
         .area = area_of(face)});
    add_triangles(TopoDS::Face(face), static_cast<LocalIndex>(row), described);
  }
  add_solids(content, described);
  add_edges(content, described);
  return described;
}

}  // namespace tessera::cad
