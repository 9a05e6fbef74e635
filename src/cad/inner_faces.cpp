// SPDX-License-Identifier: BSD-3-Clause
#include "cad/inner_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomLib.hxx>
#include <Geom_BoundedSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gp_Pln.hxx>

#include "tessera/base/error.hpp"

#include "cad/inner_lines.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Directions in space that a surface is continued in have no end of their own: that far is enough.
struct Reach {
  double length = 0.0;
  TopoDS_Shape solid{};
};

// Whether one plane face lies in the plane of another.
bool are_in_one_plane(const TopoDS_Face& a, const TopoDS_Face& b)
{
  const BRepAdaptor_Surface of_a(a);
  const BRepAdaptor_Surface of_b(b);
  if (of_a.GetType() != GeomAbs_Plane || of_b.GetType() != GeomAbs_Plane) return false;
  const gp_Pln plane = of_a.Plane();
  return plane.Axis().IsParallel(of_b.Plane().Axis(), Precision::Angular())
         && plane.Distance(of_b.Plane().Location()) < Precision::Confusion();
}

using Bounds = std::array<double, 4>;  // Of both parameters: lowest and highest u, then v.

Bounds bounds_of(const TopoDS_Face& face)
{
  Bounds uv{};
  BRepTools::UVBounds(face, uv[0], uv[1], uv[2], uv[3]);
  return uv;
}

TopoDS_Face on_whole_surface(const TopoDS_Face& face, const Bounds& bounds)
{
  return BRepBuilderAPI_MakeFace(BRep_Tool::Surface(face), bounds[0], bounds[1], bounds[2],
                                 bounds[3], Precision::Confusion());
}

// A cone is continued on the face's side of its apex.
TopoDS_Face on_cone(const TopoDS_Face& face, const gp_Cone& cone, double reach)
{
  const Bounds uv = bounds_of(face);
  const double apex = -cone.RefRadius() / std::sin(cone.SemiAngle());
  const bool is_above = 0.5 * (uv[2] + uv[3]) > apex;
  const double low = is_above ? std::max(apex, uv[2] - reach) : uv[2] - reach;
  const double high = is_above ? uv[3] + reach : std::min(apex, uv[3] + reach);
  return on_whole_surface(face, {0.0, 2.0 * std::numbers::pi, low, high});
}

// Free-form surfaces go on with their tangents.
TopoDS_Face on_free_form(const TopoDS_Face& face, double reach)
{
  const Bounds uv = bounds_of(face);
  Handle(Geom_BoundedSurface) surface =
      new Geom_RectangularTrimmedSurface(BRep_Tool::Surface(face), uv[0], uv[1], uv[2], uv[3]);
  for (const bool along_u : {true, false}) {
    for (const bool at_end : {true, false}) {
      GeomLib::ExtendSurfByLength(surface, reach, 1, along_u, at_end);
    }
  }
  return BRepBuilderAPI_MakeFace(surface, Precision::Confusion());
}

TopoDS_Face continued(const TopoDS_Face& face, const Reach& reach)
{
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const BRepAdaptor_Surface surface(face);
  const Bounds uv = bounds_of(face);
  switch (surface.GetType()) {
    case GeomAbs_Plane: {
      const gp_Pln plane = surface.Plane();
      return plane_face(from_occ(plane.Location()), from_occ(plane.Axis().Direction().XYZ()),
                        reach.solid);
    }
    case GeomAbs_Cylinder:
      return on_whole_surface(face, {0.0, kTurn, uv[2] - reach.length, uv[3] + reach.length});
    case GeomAbs_Cone:
      return on_cone(face, surface.Cone(), reach.length);
    case GeomAbs_Sphere:
      return on_whole_surface(face, {0.0, kTurn, -0.25 * kTurn, 0.25 * kTurn});
    case GeomAbs_Torus:
      return on_whole_surface(face, {0.0, kTurn, 0.0, kTurn});
    default:
      return on_free_form(face, reach.length);
  }
}

TopTools_ListOfShape tools_for(const TopoDS_Shape& solid)
{
  const Reach reach{box_diagonal_of(solid), solid};
  std::vector<TopoDS_Face> done;
  TopTools_ListOfShape tools;
  for (const TopoDS_Shape& part : inner_faces_of(solid)) {
    const TopoDS_Face& face = TopoDS::Face(part);
    const bool is_done = std::ranges::any_of(
        done, [&](const TopoDS_Face& other) { return are_in_one_plane(face, other); });
    if (is_done) continue;
    done.push_back(face);
    tools.Append(continued(face, reach));
  }
  return tools;
}

void require_no_inner_faces(const CutShape& cells)
{
  for (const TopoDS_Shape& cell : parts_of(cells.shape, TopAbs_SOLID)) {
    const std::vector<TopoDS_Shape> left = inner_faces_of(cell);
    if (left.empty()) continue;
    const BRepAdaptor_Surface surface(TopoDS::Face(left.front()));
    const gp_Pnt place =
        surface.Value(0.5 * (surface.FirstUParameter() + surface.LastUParameter()),
                      0.5 * (surface.FirstVParameter() + surface.LastVParameter()));
    throw NetgenError(fmt::format(
        "a face that ends inside of a solid, near ({:g}), cannot be continued to the solid's "
        "sides; take plane ones, or continue it in the CAD program",
        fmt::join(from_occ(place), ", ")));
  }
}

}  // namespace

std::vector<TopoDS_Shape> inner_faces_of(const TopoDS_Shape& solid)
{
  std::vector<TopoDS_Shape> inner;
  TopTools_MapOfShape seen;
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Shape& face = faces.Current();
    if (face.Orientation() == TopAbs_INTERNAL && seen.Add(face)) inner.push_back(face);
  }
  return inner;
}

TopTools_MapOfShape faces_inside_of_bodies(const TopoDS_Shape& shape,
                                           const std::vector<LocalIndex>& solid_body)
{
  TopTools_MapOfShape inside;
  TopTools_DataMapOfShapeInteger body_of;
  std::size_t row = 0;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next(), ++row) {
    const int body = solid_body.at(row);
    for (const TopoDS_Shape& face : parts_of(solids.Current(), TopAbs_FACE)) {
      const int* const other = body_of.Seek(face);
      if (other != nullptr && *other == body) inside.Add(face);
      body_of.Bind(face, body);
    }
    for (const TopoDS_Shape& face : inner_faces_of(solids.Current())) inside.Add(face);
  }
  return inside;
}

bool has_inner_parts(const TopoDS_Shape& shape)
{
  return !inner_lines_of(shape).empty()
         || std::ranges::any_of(parts_of(shape, TopAbs_SOLID), [](const TopoDS_Shape& solid) {
              return !inner_faces_of(solid).empty();
            });
}

CutShape cells_of(const TopoDS_Shape& shape)
{
  const std::vector<TopoDS_Shape> lines = inner_lines_of(shape);
  const Vec3 sweep = lines.empty() ? Vec3{} : sweep_of(lines);
  std::vector<TopTools_ListOfShape> tools;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    tools.push_back(tools_for(solids.Current()));
    append_curtains(lines, sweep, solids.Current(), tools.back());
  }
  CutShape cells = cut_at_faces(shape, std::move(tools));
  require_no_inner_faces(cells);
  require_lines(cells, shape);
  return cells;
}

}  // namespace tessera::cad
