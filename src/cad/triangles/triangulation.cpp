// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>

#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"

#include "cad/error.hpp"
#include "cad/shape.hpp"
#include "cad/triangles/face_loops.hpp"
#include "cad/triangles/whole_face.hpp"

namespace tessera::cad {
namespace {

using Point = geometry::PlaneMesh::Point;

constexpr std::size_t kMostPoints =
    20'000;  // Of a face of our own; more means that its parameters are odd.

class FaceTriangulator {
 public:
  FaceTriangulator(const TopoDS_Face& face, const Closeness& closeness)
      : face_(face),
        closeness_(closeness),
        boundary_(loops_of(face, closeness)),
        surface_(BRep_Tool::Surface(face)),
        to_face_(face.Location().Inverted().Transformation())
  {
    set_scales();
  }

  // Whether the face has triangles now.
  bool run()
  {
    if (!order_loops()) return false;
    std::vector<Point> points;
    for (const Point& uv : boundary_.uv) points.push_back(to_plane(uv));
    geometry::PlaneMesh mesh = geometry::triangulate_polygon(std::move(points), boundary_.loops,
                                                             BRep_Tool::Tolerance(face_));
    if (mesh.triangles.empty()) return false;
    geometry::refine_inside(
        mesh, [this](const Point& a, const Point& b) { return is_off(a, b); }, kMostPoints);
    store(mesh);
    return true;
  }

 private:
  void set_scales()
  {
    const std::array<double, 2> speeds = parameter_speeds(surface_, boundary_.uv);
    for (std::size_t k = 0; k < 2; ++k) {
      if (speeds[k] > 0.0) scale_[k] = speeds[k];
    }
  }

  // A plane in which lengths are about those on the surface: there Delaunay triangles are good
  // ones.
  [[nodiscard]] Point to_plane(const Point& uv) const
  {
    return {scale_[0] * uv[0], scale_[1] * uv[1]};
  }
  [[nodiscard]] gp_Pnt2d to_uv(const Point& p) const
  {
    return {p[0] / scale_[0], p[1] / scale_[1]};
  }
  [[nodiscard]] gp_Pnt on_surface(const Point& p) const
  {
    const gp_Pnt2d uv = to_uv(p);
    return surface_->Value(uv.X(), uv.Y());
  }

  [[nodiscard]] bool is_off(const Point& a, const Point& b) const
  {
    const gp_Pnt middle = on_surface({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])});
    const gp_XYZ chord = 0.5 * (on_surface(a).XYZ() + on_surface(b).XYZ());
    return middle.Distance(chord) > closeness_.deflection;
  }

  // The largest loop is the outer one. It should run counter-clockwise, for the face is upright; a
  // face as narrow as its tolerance may have it the other way round.
  bool order_loops()
  {
    std::vector<geometry::PlaneMesh::Loop>& loops = boundary_.loops;
    if (loops.empty()) return false;
    const auto size = [this](const geometry::PlaneMesh::Loop& loop) {
      return std::abs(geometry::signed_area(boundary_.uv, loop));
    };
    std::ranges::stable_sort(loops, std::ranges::greater{}, size);
    for (std::size_t h = 1; h < loops.size(); ++h) {
      if (geometry::signed_area(boundary_.uv, loops[h]) > 0.0) std::ranges::reverse(loops[h]);
    }
    return true;
  }

  void store(const geometry::PlaneMesh& mesh) const
  {
    const Handle(Poly_Triangulation) triangles =
        new Poly_Triangulation(static_cast<int>(mesh.points.size()),
                               static_cast<int>(mesh.triangles.size()), Standard_True);
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      triangles->SetNode(static_cast<int>(n) + 1, on_surface(mesh.points[n]).Transformed(to_face_));
      triangles->SetUVNode(static_cast<int>(n) + 1, to_uv(mesh.points[n]));
    }
    put_on_curves(*triangles);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      triangles->SetTriangle(static_cast<int>(t) + 1, Poly_Triangle(a + 1, b + 1, c + 1));
    }
    triangles->Deflection(closeness_.deflection);
    BRepTools::Clean(face_);  // Else polygons of earlier triangles would be taken for ones in use.
    BRep_Builder().UpdateFace(face_, triangles);
    store_sides(triangles);
  }

  // Neighbours have their points on the curve in space.
  void put_on_curves(Poly_Triangulation& triangles) const
  {
    for (const FaceSide& side : boundary_.sides) {
      double first = 0.0;
      double last = 0.0;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(side.edge, first, last);
      if (curve.IsNull() || BRep_Tool::Degenerated(side.edge)) continue;
      for (std::size_t i = 0; i < side.t.size(); ++i) {
        triangles.SetNode(side.nodes[i] + 1, curve->Value(side.t[i]).Transformed(to_face_));
      }
    }
  }

  static Handle(Poly_PolygonOnTriangulation) polygon_of(const FaceSide& side)
  {
    const int count = static_cast<int>(side.t.size());
    TColStd_Array1OfInteger nodes(1, count);
    TColStd_Array1OfReal parameters(1, count);
    for (int i = 1; i <= count; ++i) {
      nodes.SetValue(i, side.nodes[at(i - 1)] + 1);
      parameters.SetValue(i, side.t[at(i - 1)]);
    }
    return new Poly_PolygonOnTriangulation(nodes, parameters);
  }

  // A seam has two, for the two times that the boundary goes along it.
  void store_sides(const Handle(Poly_Triangulation) & triangles) const
  {
    for (const FaceSide& side : boundary_.sides) {
      const auto is_other_side = [&](const FaceSide& other) {
        return other.edge.IsSame(side.edge) && other.edge.Orientation() != side.edge.Orientation();
      };
      const auto other = std::ranges::find_if(boundary_.sides, is_other_side);
      if (other == boundary_.sides.end()) {
        BRep_Builder().UpdateEdge(side.edge, polygon_of(side), triangles, face_.Location());
      } else if (side.edge.Orientation() == TopAbs_FORWARD) {
        BRep_Builder().UpdateEdge(side.edge, polygon_of(side), polygon_of(*other), triangles,
                                  face_.Location());
      }
    }
  }

  TopoDS_Face face_;
  Closeness closeness_;
  FaceLoops boundary_;
  Handle(Geom_Surface) surface_;
  gp_Trsf to_face_;  ///< Triangles of a face are where its own location is not counted.
  std::array<double, 2> scale_{1.0, 1.0};
};

// OpenCASCADE's relative deflection is one of each edge; ours is one of the face.
Closeness closeness_for(const TopoDS_Shape& face, const IMeshTools_Parameters& parameters)
{
  const double unit = parameters.Relative ? box_diagonal_of(face) : 1.0;
  return {parameters.Deflection * unit, parameters.Angle};
}

IMeshTools_Parameters finer_than(IMeshTools_Parameters parameters, double part)
{
  parameters.Deflection *= part;
  parameters.Angle *= std::sqrt(part);
  return parameters;
}

// The finest first: OpenCASCADE leaves triangles and edges alone that are as fine as it is asked
// for, or finer.
void triangulate_finer(const std::vector<TopoDS_Shape>& faces, const std::vector<double>& face_part,
                       const IMeshTools_Parameters& parameters)
{
  const std::set<double> parts(face_part.begin(), face_part.end());
  for (const double part : parts) {
    if (part >= 1.0) break;
    TopoDS_Compound some;
    BRep_Builder().MakeCompound(some);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (face_part[f] == part) BRep_Builder().Add(some, faces[f]);
    }
    BRepMesh_IncrementalMesh(some, finer_than(parameters, part));
  }
}

// Of the boundary's points: a face without sound boundary may have no bounds of its own.
std::array<Point, 2> parameter_box(const TopoDS_Face& face)
{
  const TopoDS_Shape upright = face.Oriented(TopAbs_FORWARD);
  const FaceLoops boundary = loops_of(TopoDS::Face(upright), {box_diagonal_of(face), 1.0});
  std::array<Point, 2> box{};
  bool is_first = true;
  for (const FaceSide& side : boundary.sides) {
    for (const Point& uv : side.uv) {
      if (std::exchange(is_first, false)) box = {uv, uv};
      for (std::size_t k = 0; k < 2; ++k) {
        box[0][k] = std::min(box[0][k], uv[k]);
        box[1][k] = std::max(box[1][k], uv[k]);
      }
    }
  }
  return box;
}

}  // namespace

bool triangulate_from_boundary(const TopoDS_Shape& face, const Closeness& closeness)
{
  const TopoDS_Shape upright = face.Oriented(TopAbs_FORWARD);
  try {
    return FaceTriangulator(TopoDS::Face(upright), closeness).run();
  } catch (const Standard_Failure& failure) {
    note_given_up("triangles of a face from its boundary", error_of(failure));
    return false;
  }
}

std::vector<int> triangulate_faces(const TopoDS_Shape& shape,
                                   const IMeshTools_Parameters& parameters,
                                   const std::vector<double>& face_part)
{
  constexpr std::array<double, 3> kFiner{1.0, 0.3, 0.1};
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  const auto part = [&](std::size_t f) { return face_part.empty() ? 1.0 : face_part[f]; };
  std::vector<int> bare;
  int num_from_boundary = 0;
  for (const double finer : kFiner) {
    IMeshTools_Parameters finer_parameters = parameters;
    finer_parameters.Deflection *= finer;
    BRepTools::Clean(shape);
    triangulate_finer(faces, face_part, finer_parameters);
    BRepMesh_IncrementalMesh(shape, finer_parameters);
    bare.clear();
    num_from_boundary = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const TopoDS_Face& face = TopoDS::Face(faces[f]);
      const Closeness closeness = closeness_for(face, finer_than(finer_parameters, part(f)));
      const bool is_whole = has_whole_triangles(face);
      if (is_whole && follows_surface(face, closeness.deflection)) continue;
      if (!is_left_out(Repair::face_from_boundary) && triangulate_from_boundary(face, closeness)) {
        ++num_from_boundary;
      } else if (!is_whole) {
        bare.push_back(static_cast<int>(f));
      }
    }
    if (bare.empty()) break;
  }
  note_repair(Repair::face_from_boundary, num_from_boundary);
  return bare;
}

void sample_face(const TopoDS_Shape& face)
{
  constexpr int kCells = 8;  // A side.
  const std::array<Point, 2> box = parameter_box(TopoDS::Face(face));
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(face));
  const gp_Trsf to_face = face.Location().Inverted().Transformation();
  const Handle(Poly_Triangulation) triangles =
      new Poly_Triangulation((kCells + 1) * (kCells + 1), 2 * kCells * kCells, Standard_True);
  const auto node = [](int i, int j) { return 1 + i * (kCells + 1) + j; };
  for (int i = 0; i <= kCells; ++i) {
    for (int j = 0; j <= kCells; ++j) {
      const gp_Pnt2d uv(box[0][0] + (box[1][0] - box[0][0]) * i / kCells,
                        box[0][1] + (box[1][1] - box[0][1]) * j / kCells);
      triangles->SetNode(node(i, j), surface->Value(uv.X(), uv.Y()).Transformed(to_face));
      triangles->SetUVNode(node(i, j), uv);
    }
  }
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const int number = 1 + 2 * (i * kCells + j);
      const int a = node(i, j);
      const int c = node(i + 1, j + 1);
      triangles->SetTriangle(number, Poly_Triangle(a, node(i + 1, j), c));
      triangles->SetTriangle(number + 1, Poly_Triangle(a, c, node(i, j + 1)));
    }
  }
  BRep_Builder().UpdateFace(TopoDS::Face(face), triangles);
}

}  // namespace tessera::cad
