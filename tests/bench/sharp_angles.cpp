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
#include <BRepLProp_SLProps.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

namespace {

constexpr int num_places = 7;
constexpr double normal_tolerance = 1e-9;

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

double angle_of_wire(const TopoDS_Wire& wire, const TopoDS_Face& face)
{
  std::vector<Use> uses;
  for (BRepTools_WireExplorer edge(wire, face); edge.More(); edge.Next()) {
    uses.push_back({edge.Current(), face});
  }
  double smallest = 360.0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Use &one = uses[i], &next = uses[(i + 1) % uses.size()];
    if (BRep_Tool::Degenerated(one.edge) || BRep_Tool::Degenerated(next.edge)) continue;
    if (one.edge.IsSame(next.edge)) continue;  // A slit: back the way it came.
    smallest = std::min(smallest, angle_of_edges(one, next));
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

gp_Vec normal_of(const Poly_Triangulation& surface, int triangle)
{
  int a = 0, b = 0, c = 0;
  surface.Triangle(triangle).Get(a, b, c);
  const gp_Pnt corner = surface.Node(a);
  return gp_Vec(corner, surface.Node(b)).Crossed(gp_Vec(corner, surface.Node(c)));
}

}  // namespace

SharpAngles sharp_angles(const TopoDS_Shape& solid)
{
  SharpAngles found;
  for (const std::vector<Use>& uses : uses_of_edges(solid)) {
    if (uses.size() != 2 || BRep_Tool::Degenerated(uses[0].edge)) continue;
    found.of_faces = std::min(found.of_faces, angle_of_faces(uses[0], uses[1]));
  }
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    // The explorer of a wire goes along its edges only in a face as it was made.
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    for (TopExp_Explorer wire(face, TopAbs_WIRE); wire.More(); wire.Next()) {
      found.of_edges = std::min(found.of_edges, angle_of_wire(TopoDS::Wire(wire.Current()), face));
    }
  }
  return found;
}

SharpAngles sharp_angles(const Poly_Triangulation& closed_surface)
{
  std::map<std::pair<int, int>, int> triangle_at;  // Of each directed edge.
  for (int t = 1; t <= closed_surface.NbTriangles(); ++t) {
    std::array<int, 3> corner{};
    closed_surface.Triangle(t).Get(corner[0], corner[1], corner[2]);
    for (std::size_t c = 0; c < 3; ++c) triangle_at[{corner[c], corner[(c + 1) % 3]}] = t;
  }
  SharpAngles found;
  for (const auto& [edge, triangle] : triangle_at) {
    const auto other = triangle_at.find({edge.second, edge.first});
    if (edge.first > edge.second || other == triangle_at.end()) continue;
    const auto along =
        unit(gp_Vec(closed_surface.Node(edge.first), closed_surface.Node(edge.second)));
    const auto normal = unit(normal_of(closed_surface, triangle));
    const auto other_normal = unit(normal_of(closed_surface, other->second));
    if (!along || !normal || !other_normal) continue;
    found.of_faces = std::min(found.of_faces, angle_between(*normal, normal->Crossed(*along),
                                                            -other_normal->Crossed(*along)));
  }
  return found;
}
