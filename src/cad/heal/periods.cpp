// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/periods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <ShapeExtend_WireData.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec2d.hxx>
#include <gp_XY.hxx>

#include "tessera/base/types.hpp"

namespace tessera::cad {
namespace {

// Of the edge and its ends: a pole is no more exact than its vertex.
double tolerance_of(const TopoDS_Edge& edge)
{
  double tolerance = BRep_Tool::Tolerance(edge);
  for (TopExp_Explorer ends(edge, TopAbs_VERTEX); ends.More(); ends.Next()) {
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(ends.Current())));
  }
  return tolerance;
}

// Whether the surface is at more than one place along a curve in its parameters.
bool leaves_a_point(const Geom2d_Curve& curve, const Geom_Surface& surface, double first,
                    double last, double most)
{
  // An odd number: places half a period apart would miss no circle, but those a period apart do.
  constexpr int kPlaces = 7;
  const auto place = [&](int i) {
    const gp_Pnt2d uv = curve.Value(first + (last - first) * i / kPlaces);
    return surface.Value(uv.X(), uv.Y());
  };
  const gp_Pnt start = place(0);
  for (int i = 1; i <= kPlaces; ++i) {
    if (place(i).Distance(start) > most) return true;
  }
  return false;
}

bool is_false_point(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
  if (!BRep_Tool::Degenerated(edge)) return false;
  double first = 0.0;
  double last = 0.0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (curve.IsNull()) return false;
  try {
    return leaves_a_point(*curve, *BRep_Tool::Surface(face), first, last,
                          10.0 * tolerance_of(edge));
  } catch (const Standard_Failure&) {
    return false;  // Some surfaces have no value at their poles.
  }
}

// Calls `use` with every edge of every face that is falsely marked as a point.
template <class Use>
void for_each_false_point(const TopoDS_Shape& shape, const Use& use)
{
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    for (TopExp_Explorer edges(faces.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      if (is_false_point(edge, TopoDS::Face(faces.Current()))) use(edge);
    }
  }
}

struct Ends {
  gp_Pnt2d from{};
  gp_Pnt2d to{};
};

// Of each edge, in the direction in which the wire runs through it. Empty if one has no parameters.
std::vector<Ends> ends_of(const ShapeExtend_WireData& wire, const TopoDS_Face& face)
{
  std::vector<Ends> all;
  for (int i = 1; i <= wire.NbEdges(); ++i) {
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(wire.Edge(i), face, first, last);
    if (curve.IsNull()) return {};
    if (wire.Edge(i).Orientation() == TopAbs_REVERSED) std::swap(first, last);
    all.push_back({curve->Value(first), curve->Value(last)});
  }
  return all;
}

// What lies nearby in the parameters of a wire, and the periods.
struct Measures {
  std::array<double, 2> period{};  // In u and v; 0: none.
  std::array<double, 2> near{};
};

Measures measures_of(const std::vector<Ends>& wire, const TopoDS_Face& face)
{
  constexpr double kNear = 1e-4;  // Of a period, or of the wire.
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  Measures measures{{surface->IsUPeriodic() ? surface->UPeriod() : 0.0,
                     surface->IsVPeriodic() ? surface->VPeriod() : 0.0}};
  for (int i = 0; i < 2; ++i) {
    const auto [least, most] =
        std::ranges::minmax(wire, {}, [&](const Ends& ends) { return ends.from.Coord(i + 1); });
    const double extent = most.from.Coord(i + 1) - least.from.Coord(i + 1);
    const double period = measures.period[at(i)];
    measures.near[at(i)] = kNear * (period > 0.0 ? period : extent);
  }
  return measures;
}

// The whole periods that bring `start` to `end`. Nothing if it is not near then: the wire is not in
// order, or has a gap.
std::optional<gp_Vec2d> move_between(const gp_Pnt2d& end, const gp_Pnt2d& start,
                                     const Measures& measures)
{
  gp_XY move(0.0, 0.0);
  for (int i = 0; i < 2; ++i) {
    const double gap = end.Coord(i + 1) - start.Coord(i + 1);
    const double period = measures.period[at(i)];
    const double whole = period > 0.0 ? period * std::round(gap / period) : 0.0;
    if (std::abs(gap - whole) > measures.near[at(i)]) return std::nullopt;
    move.SetCoord(i + 1, whole);
  }
  return gp_Vec2d(move);
}

// Which edge follows, and how it is to be moved.
struct Next {
  std::size_t edge = 0;
  gp_Vec2d move{};
};

// One that needs no move first: at a seam, there may be two that begin a period apart.
std::optional<Next> next_edge(const std::vector<Ends>& wire, const std::vector<char>& is_used,
                              const gp_Pnt2d& end, const Measures& measures)
{
  std::optional<Next> next;
  for (std::size_t i = 0; i < wire.size(); ++i) {
    if (is_used[i] != 0) continue;
    const auto move = move_between(end, wire[i].from, measures);
    if (!move || (next && move->Magnitude() >= next->move.Magnitude())) continue;
    next = Next{i, *move};
  }
  return next;
}

// For each edge; empty if the wire does not close in this way. Edges may come in any order.
std::vector<gp_Vec2d> moves_of(const std::vector<Ends>& wire, const TopoDS_Face& face)
{
  if (wire.empty()) return {};
  const Measures measures = measures_of(wire, face);
  std::vector<gp_Vec2d> moves(wire.size(), gp_Vec2d(0.0, 0.0));
  std::vector<char> is_used(wire.size(), 0);
  is_used[0] = 1;
  gp_Pnt2d end = wire.front().to;
  for (std::size_t i = 1; i < wire.size(); ++i) {
    const auto next = next_edge(wire, is_used, end, measures);
    if (!next) return {};
    is_used[next->edge] = 1;
    moves[next->edge] = next->move;
    end = wire[next->edge].to.Translated(next->move);
  }
  const auto last = move_between(end, wire.front().from, measures);
  return last && last->Magnitude() == 0.0 ? moves : std::vector<gp_Vec2d>{};
}

// A seam has two curves; which of them is meant is in the direction of the edge.
void move_curve(const TopoDS_Edge& edge, const TopoDS_Face& face, const gp_Vec2d& move)
{
  double first = 0.0;
  double last = 0.0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  const Handle(Geom2d_Curve) moved = Handle(Geom2d_Curve)::DownCast(curve->Translated(move));
  const double tolerance = BRep_Tool::Tolerance(edge);
  const BRep_Builder builder;
  if (!BRep_Tool::IsClosed(edge, face)) {
    builder.UpdateEdge(edge, moved, face, tolerance);
    return;
  }
  const TopoDS_Edge reversed = TopoDS::Edge(edge.Reversed());
  const Handle(Geom2d_Curve) other = BRep_Tool::CurveOnSurface(reversed, face, first, last);
  const bool is_second = edge.Orientation() == TopAbs_REVERSED;
  builder.UpdateEdge(edge, is_second ? other : moved, is_second ? moved : other, face, tolerance);
}

}  // namespace

bool has_false_points(const TopoDS_Shape& shape)
{
  bool has_any = false;
  for_each_false_point(shape, [&](const TopoDS_Edge& /*edge*/) { has_any = true; });
  return has_any;
}

TopoDS_Shape with_closed_wires(const TopoDS_Shape& shape, ShapeBuild_ReShape& changes)
{
  for_each_false_point(shape, [&](const TopoDS_Edge& edge) { changes.Remove(edge); });
  const TopoDS_Shape better = changes.Apply(shape);
  for (TopExp_Explorer faces(better, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
      const Handle(ShapeExtend_WireData) wire =
          new ShapeExtend_WireData(TopoDS::Wire(wires.Current()));
      const std::vector<gp_Vec2d> moves = moves_of(ends_of(*wire, face), face);
      for (std::size_t i = 0; i < moves.size(); ++i) {
        if (moves[i].Magnitude() > 0.0) {
          move_curve(wire->Edge(static_cast<int>(i) + 1), face, moves[i]);
        }
      }
    }
  }
  return better;
}

}  // namespace tessera::cad
