// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/whole_face.hpp"

#include <algorithm>
#include <array>
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

#include "tessera/base/types.hpp"

namespace tessera::cad {
namespace {

using Segment = std::pair<int, int>;

// An edge of a triangle is off the surface if its middle is so many deflections and so much of its
// length off: of linkrods, screw, CrankArm and bottle no face has one, of a screw with its thread
// one flank has (3.9 deflections, 0.15), and points lay inside of its core.
constexpr double kMostDeflections = 3.0;
constexpr double kMostBow = 0.1;

// In lengths of the edge: what is longer in parameters goes another way, as from a pole.
constexpr double kMostDetour = 1.3;

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

}  // namespace

bool has_whole_triangles(const TopoDS_Face& face) { return FaceBorder(face).is_whole(); }

bool follows_surface(const TopoDS_Face& face, double deflection)
{
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  if (mesh.IsNull() || !mesh->HasUVNodes()) return true;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const auto is_near = [&](int a, int b) {
    const gp_XYZ from = mesh->Node(a).Transformed(place).XYZ();
    const gp_XYZ to = mesh->Node(b).Transformed(place).XYZ();
    const double length = (to - from).Modulus();
    const gp_XY uv = 0.5 * (mesh->UVNode(a).XY() + mesh->UVNode(b).XY());
    gp_Pnt middle;
    gp_Vec by_u;
    gp_Vec by_v;
    surface->D1(uv.X(), uv.Y(), middle, by_u, by_v);
    const double off = (middle.XYZ() - 0.5 * (from + to)).Modulus();
    if (off <= kMostDeflections * deflection || off <= kMostBow * length) return true;
    const gp_XY step = mesh->UVNode(b).XY() - mesh->UVNode(a).XY();
    return (by_u * step.X() + by_v * step.Y()).Magnitude() > kMostDetour * length;
  };
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    std::array<int, 3> nodes{};
    mesh->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!is_near(nodes[c], nodes[(c + 1) % 3])) return false;
    }
  }
  return true;
}

}  // namespace tessera::cad
