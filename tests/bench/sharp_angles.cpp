// SPDX-License-Identifier: BSD-3-Clause
#include "sharp_angles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepLProp_SLProps.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

namespace {

constexpr int num_places = 7;
constexpr double normal_tolerance = 1e-9;

// Triangles that meet at a larger angle, in degrees, have an edge of the model between them: what
// Tessera takes for one in STL files.
constexpr double curve_angle = 30.0;

// An edge as one face has it; a seam is there twice.
struct Use {
  TopoDS_Edge edge;
  TopoDS_Face face;
};

// The direction of travel with the face on the left, seen from outside, and the normal outwards.
struct Place {
  gp_Vec along;
  gp_Vec normal;
};

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

std::optional<gp_Vec> unit(const gp_Vec& vector)
{
  const double length = vector.Magnitude();
  if (!(length > 1e-12)) return std::nullopt;
  return vector / length;
}

// At a share of the parameters of the edge; none at a pole or where the tangent vanishes.
std::optional<Place> place_of(const Use& use, double share)
{
  double first = 0.0, last = 0.0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(use.edge, use.face, first, last);
  if (curve.IsNull()) return std::nullopt;
  const double parameter = first + share * (last - first);
  gp_Pnt point;
  gp_Vec along;
  BRepAdaptor_Curve(use.edge).D1(parameter, point, along);
  const gp_Pnt2d at = curve->Value(parameter);
  BRepLProp_SLProps surface(BRepAdaptor_Surface(use.face, false), at.X(), at.Y(), 1,
                            normal_tolerance);
  const std::optional<gp_Vec> tangent = unit(along);
  if (!tangent || !surface.IsNormalDefined()) return std::nullopt;
  const bool back = use.edge.Orientation() == TopAbs_REVERSED;
  const bool inwards = use.face.Orientation() == TopAbs_REVERSED;
  const gp_Vec normal(surface.Normal());
  return Place{back ? -*tangent : *tangent, inwards ? -normal : normal};
}

// Through the solid, of two faces with these normals outwards and directions away from the edge.
double angle_between(const gp_Vec& normal, const gp_Vec& into_one, const gp_Vec& into_other)
{
  const double angle = std::acos(std::clamp(into_one.Dot(into_other), -1.0, 1.0));
  const bool is_notch = normal.Dot(into_other) > 1e-6;
  return is_notch ? 360.0 - degrees(angle) : degrees(angle);
}

double angle_of_faces(const Use& one, const Use& other)
{
  double smallest = 360.0;
  for (int i = 0; i < num_places; ++i) {
    const double share = 0.02 + 0.96 * i / (num_places - 1);
    const auto here = place_of(one, share), there = place_of(other, share);
    if (!here || !there) continue;
    const auto into_one = unit(here->normal.Crossed(here->along));
    const auto into_other = unit(there->normal.Crossed(there->along));
    if (!into_one || !into_other) continue;
    smallest = std::min(smallest, angle_between(here->normal, *into_one, *into_other));
  }
  return smallest;
}

// From one direction to the other, with `normal` up, in degrees above -180 and up to 180.
double turned(const gp_Vec& normal, const gp_Vec& from, const gp_Vec& to)
{
  return degrees(std::atan2(normal.Dot(from.Crossed(to)), from.Dot(to)));
}

gp_Vec from_end(const TopoDS_Edge& edge, double end, double near)
{
  const BRepAdaptor_Curve curve(edge);
  const double first = curve.FirstParameter(), length = curve.LastParameter() - first;
  return {curve.Value(first + end * length), curve.Value(first + near * length)};
}

// From the edge that arrives at a vertex to the one that leaves it, through the face.
double angle_of_edges(const Use& arriving, const Use& leaving)
{
  const bool arrives_back = arriving.edge.Orientation() == TopAbs_REVERSED;
  const bool leaves_back = leaving.edge.Orientation() == TopAbs_REVERSED;
  const auto end = place_of(arriving, arrives_back ? 0.0 : 1.0);
  const auto start = place_of(leaving, leaves_back ? 1.0 : 0.0);
  if (!end || !start) return 360.0;
  const double angle = turned(start->normal, start->along, -end->along);
  if (std::abs(angle) > 1.0) return angle < 0.0 ? 360.0 + angle : angle;
  // The edges touch: a cusp of the face, or all round but a cusp.
  const gp_Vec back =
      arrives_back ? from_end(arriving.edge, 0.0, 0.05) : from_end(arriving.edge, 1.0, 0.95);
  const gp_Vec on =
      leaves_back ? from_end(leaving.edge, 1.0, 0.95) : from_end(leaving.edge, 0.0, 0.05);
  return turned(start->normal, on, back) < 0.0 ? 360.0 + angle : std::abs(angle);
}

std::vector<Use> uses_in(const TopoDS_Face& face)
{
  std::vector<Use> uses;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    const bool is_border =
        edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
    if (is_border && !BRep_Tool::Degenerated(edge)) uses.push_back({edge, face});
  }
  return uses;
}

// Of each edge that leaves a vertex with each that arrives there, also on another wire: a hole may
// touch the border. What does not follow in the face is farther round.
double angle_of_corners(const TopoDS_Face& face)
{
  const std::vector<Use> uses = uses_in(face);
  double smallest = 360.0;
  for (const Use& leaving : uses) {
    const TopoDS_Vertex vertex = TopExp::FirstVertex(leaving.edge, true);
    for (const Use& arriving : uses) {
      if (arriving.edge.IsSame(leaving.edge)) continue;  // A slit: back the way it came.
      if (!vertex.IsSame(TopExp::LastVertex(arriving.edge, true))) continue;
      smallest = std::min(smallest, angle_of_edges(arriving, leaving));
    }
  }
  return smallest;
}

std::vector<std::vector<Use>> uses_of_edges(const TopoDS_Shape& solid)
{
  TopTools_DataMapOfShapeInteger number_of;  // Whatever the edge's orientation.
  std::vector<std::vector<Use>> uses;
  for (TopExp_Explorer face(solid, TopAbs_FACE); face.More(); face.Next()) {
    for (TopExp_Explorer edge(face.Current(), TopAbs_EDGE); edge.More(); edge.Next()) {
      if (!number_of.IsBound(edge.Current())) {
        number_of.Bind(edge.Current(), static_cast<int>(uses.size()));
        uses.emplace_back();
      }
      uses[static_cast<std::size_t>(number_of.Find(edge.Current()))].push_back(
          {TopoDS::Edge(edge.Current()), TopoDS::Face(face.Current())});
    }
  }
  return uses;
}

// Triangles with corners of the same number joined, and what is on the other side of their edges.
class ClosedTriangles {
 public:
  explicit ClosedTriangles(const Poly_Triangulation& surface) : surface_(surface)
  {
    for (int t = 1; t <= surface.NbTriangles(); ++t) {
      const std::array<int, 3> corner = corners(t);
      for (std::size_t c = 0; c < 3; ++c) triangle_at_[{corner[c], corner[(c + 1) % 3]}] = t;
    }
  }

  [[nodiscard]] SharpAngles angles() const
  {
    SharpAngles found;
    for (const auto& [edge, triangle] : triangle_at_) {
      found.of_edges = std::min(found.of_edges, angle_of_sector(edge.first, edge.second));
      const std::optional<int> other = triangle_from(edge.second, edge.first);
      if (edge.first > edge.second || !other) continue;
      const auto along = unit(gp_Vec(surface_.Node(edge.first), surface_.Node(edge.second)));
      const auto normal = unit(normal_of(triangle)), other_normal = unit(normal_of(*other));
      if (!along || !normal || !other_normal) continue;
      found.of_faces = std::min(found.of_faces, angle_between(*normal, normal->Crossed(*along),
                                                              -other_normal->Crossed(*along)));
    }
    return found;
  }

 private:
  [[nodiscard]] std::array<int, 3> corners(int triangle) const
  {
    std::array<int, 3> corner{};
    surface_.Triangle(triangle).Get(corner[0], corner[1], corner[2]);
    return corner;
  }

  [[nodiscard]] gp_Vec normal_of(int triangle) const
  {
    const auto [a, b, c] = corners(triangle);
    const gp_Pnt corner = surface_.Node(a);
    return gp_Vec(corner, surface_.Node(b)).Crossed(gp_Vec(corner, surface_.Node(c)));
  }

  [[nodiscard]] std::optional<int> triangle_from(int from, int to) const
  {
    const auto found = triangle_at_.find({from, to});
    if (found == triangle_at_.end()) return std::nullopt;
    return found->second;
  }

  [[nodiscard]] bool is_curve(int from, int to) const
  {
    const auto one = triangle_from(from, to), other = triangle_from(to, from);
    return one && other && degrees(normal_of(*one).Angle(normal_of(*other))) > curve_angle;
  }

  // Through the face, from an edge of the model at a vertex to the next one; 360 if `from` and `to`
  // are no such edge. Several triangles may share the angle.
  [[nodiscard]] double angle_of_sector(int from, int to) const
  {
    double angle = 0.0;
    if (!is_curve(from, to)) return 360.0;
    for (auto triangle = triangle_from(from, to); triangle; triangle = triangle_from(from, to)) {
      const auto [a, b, c] = corners(*triangle);
      const int next = a + b + c - from - to;
      const gp_Vec one(surface_.Node(from), surface_.Node(to));
      const gp_Vec other(surface_.Node(from), surface_.Node(next));
      if (!unit(one) || !unit(other)) return 360.0;
      angle += degrees(one.Angle(other));
      if (is_curve(from, next) || angle > 360.0) return angle;
      to = next;
    }
    return 360.0;
  }

  const Poly_Triangulation& surface_;
  std::map<std::pair<int, int>, int> triangle_at_;  // Of each directed edge.
};

}  // namespace

SharpAngles sharp_angles(const TopoDS_Shape& solid)
{
  SharpAngles found;
  for (const std::vector<Use>& uses : uses_of_edges(solid)) {
    if (uses.size() != 2 || BRep_Tool::Degenerated(uses[0].edge)) continue;
    found.of_faces = std::min(found.of_faces, angle_of_faces(uses[0], uses[1]));
  }
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    found.of_edges = std::min(found.of_edges, angle_of_corners(face));
  }
  return found;
}

SharpAngles sharp_angles_of_glued(const TopTools_ListOfShape& solids)
{
  SharpAngles found;
  BRepAlgoAPI_BuilderAlgo glue;
  glue.SetArguments(solids);
  glue.SetNonDestructive(Standard_True);
  glue.Build();
  if (glue.HasErrors()) return found;
  for (TopExp_Explorer parts(glue.Shape(), TopAbs_SOLID); parts.More(); parts.Next()) {
    const SharpAngles angles = sharp_angles(parts.Current());
    found.of_faces = std::min(found.of_faces, angles.of_faces);
    found.of_edges = std::min(found.of_edges, angles.of_edges);
  }
  return found;
}

SharpAngles sharp_angles(const Poly_Triangulation& closed_surface)
{
  return ClosedTriangles(closed_surface).angles();
}
