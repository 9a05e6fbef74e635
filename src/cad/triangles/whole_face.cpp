// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/whole_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

#include "tessera/base/sort_unique.hpp"
#include "tessera/base/types.hpp"

namespace tessera::cad {
namespace {

using Segment = std::pair<int, int>;

// The middle of an edge of a triangle is off the surface if it is so many deflections and so much
// of its length away, along the normal. Of linkrods, screw, CrankArm and bottle no face has such an
// edge. A flank of a screw's thread has (2 and 0.08), and points lay inside of the screw's core.
constexpr double kMostDeflections = 1.5;
constexpr double kMostBow = 0.06;
constexpr double kPole = 1e-6;  // Of a derivative, in parts of that in the middle.

class FaceBorder {
 public:
  explicit FaceBorder(const TopoDS_Face& face) : mesh_(BRep_Tool::Triangulation(face, place_))
  {
    const TopoDS_Shape upright = face.Oriented(TopAbs_FORWARD);
    for (TopExp_Explorer edges(upright, TopAbs_EDGE); edges.More(); edges.Next()) {
      edges_.push_back(TopoDS::Edge(edges.Current()));
    }
  }

  // Each segment is a side of as many triangles as it is passed by the boundary, modulo two.
  bool is_whole()
  {
    if (mesh_.IsNull() || mesh_->NbTriangles() == 0) return false;
    for (int n = 0; n <= mesh_->NbNodes(); ++n) point_of_node_.push_back(n);
    for (const TopoDS_Edge& edge : edges_) {
      if (!join_ends(edge)) return false;
    }
    for (const TopoDS_Edge& edge : edges_) add_sides(edge);
    add_triangles();
    std::ranges::sort(segments_);
    for (auto first = segments_.begin(); first != segments_.end();) {
      const auto last = std::find_if(first, segments_.end(),
                                     [&](const Segment& other) { return other != *first; });
      if ((last - first) % 2 != 0) return false;
      first = last;
    }
    return true;
  }

 private:
  [[nodiscard]] auto polygon_of(const TopoDS_Edge& edge) const
  {
    return BRep_Tool::PolygonOnTriangulation(edge, mesh_, place_);
  }

  // Whether the edge has a polygon. At a pole all its points are one.
  bool join_ends(const TopoDS_Edge& edge)
  {
    const auto polygon = polygon_of(edge);
    if (polygon.IsNull()) return false;
    const bool is_pole = BRep_Tool::Degenerated(edge);
    for (int i = 1; i <= polygon->NbNodes(); ++i) {
      if (i > 1 && i < polygon->NbNodes() && !is_pole) continue;
      const TopoDS_Vertex vertex = i == 1 ? TopExp::FirstVertex(edge) : TopExp::LastVertex(edge);
      const int node = polygon->Node(i);
      if (!node_of_vertex_.IsBound(vertex)) node_of_vertex_.Bind(vertex, node);
      point_of_node_[at(node)] = node_of_vertex_.Find(vertex);
    }
    return true;
  }

  // An edge inside the face bounds none of it.
  void add_sides(const TopoDS_Edge& edge)
  {
    if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) return;
    const auto polygon = polygon_of(edge);
    for (int i = 1; i < polygon->NbNodes(); ++i) add(polygon->Node(i), polygon->Node(i + 1));
  }

  void add_triangles()
  {
    for (int t = 1; t <= mesh_->NbTriangles(); ++t) {
      std::array<int, 3> nodes{};
      mesh_->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
      for (std::size_t c = 0; c < 3; ++c) add(nodes[c], nodes[(c + 1) % 3]);
    }
  }

  void add(int a, int b)
  {
    const int p = point_of_node_[at(a)];
    const int q = point_of_node_[at(b)];
    if (p != q) segments_.emplace_back(std::minmax(p, q));
  }

  TopLoc_Location place_{};
  Handle(Poly_Triangulation) mesh_;
  std::vector<TopoDS_Edge> edges_{};
  TopTools_DataMapOfShapeInteger node_of_vertex_{};
  std::vector<int> point_of_node_{};
  std::vector<Segment> segments_{};
};

// The triangles of a face beside its surface.
class FaceTriangles {
 public:
  explicit FaceTriangles(const TopoDS_Face& face)
      : mesh_(BRep_Tool::Triangulation(face, place_)), surface_(BRep_Tool::Surface(face))
  {
  }

  [[nodiscard]] bool follow_surface(double deflection) const
  {
    if (mesh_.IsNull() || !mesh_->HasUVNodes()) return true;
    return std::ranges::none_of(
        edges(), [&](const Segment& edge) { return is_off(edge.first, edge.second, deflection); });
  }

 private:
  struct Place {
    gp_Pnt point{};
    std::array<gp_Vec, 2> slopes{};
  };

  // Each edge once.
  [[nodiscard]] std::vector<Segment> edges() const
  {
    std::vector<Segment> edges;
    for (int t = 1; t <= mesh_->NbTriangles(); ++t) {
      std::array<int, 3> nodes{};
      mesh_->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
      for (std::size_t c = 0; c < 3; ++c) {
        edges.emplace_back(std::minmax(nodes[c], nodes[(c + 1) % 3]));
      }
    }
    sort_unique(edges);
    return edges;
  }

  [[nodiscard]] Place place_at(const gp_XY& uv) const
  {
    Place there;
    surface_->D1(uv.X(), uv.Y(), there.point, there.slopes[0], there.slopes[1]);
    return there;
  }

  [[nodiscard]] bool is_off(int a, int b, double deflection) const
  {
    const gp_XYZ from = mesh_->Node(a).Transformed(place_).XYZ();
    const gp_XYZ to = mesh_->Node(b).Transformed(place_).XYZ();
    const Place middle = place_at(0.5 * (mesh_->UVNode(a).XY() + mesh_->UVNode(b).XY()));
    const gp_Vec off(middle.point.XYZ() - 0.5 * (from + to));
    const gp_Vec normal = middle.slopes[0].Crossed(middle.slopes[1]);
    const double most = std::max(kMostDeflections * deflection, kMostBow * (to - from).Modulus());
    return std::abs(off.Dot(normal)) > most * normal.Magnitude() && !is_pole(a, middle)
           && !is_pole(b, middle);
  }

  // There parameters are any, so the middle of an edge is elsewhere.
  [[nodiscard]] bool is_pole(int node, const Place& beside) const
  {
    const Place there = place_at(mesh_->UVNode(node).XY());
    return there.slopes[0].Magnitude() <= kPole * beside.slopes[0].Magnitude()
           || there.slopes[1].Magnitude() <= kPole * beside.slopes[1].Magnitude();
  }

  TopLoc_Location place_{};
  Handle(Poly_Triangulation) mesh_;
  Handle(Geom_Surface) surface_;
};

}  // namespace

bool has_whole_triangles(const TopoDS_Face& face) { return FaceBorder(face).is_whole(); }

bool follows_surface(const TopoDS_Face& face, double deflection)
{
  return FaceTriangles(face).follow_surface(deflection);
}

}  // namespace tessera::cad
