// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/face_loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

namespace tessera::cad {
namespace {

using Point = geometry::PlaneMesh::Point;

// A point of an edge belongs elsewhere in the parameters if it is off by this part of its edge.
constexpr double kMostOff = 0.01;
// Two ends that should meet are one point if they are nearer than this part of the next interval.
constexpr double kSameCorner = 0.3;

std::vector<double> evenly(double first, double last, int intervals)
{
  std::vector<double> t;
  for (int i = 0; i <= intervals; ++i) t.push_back(first + (last - first) * i / intervals);
  return t;
}

// Those of a neighbour's triangulation, if there is one.
std::vector<double> shared_parameters(const TopoDS_Edge& edge)
{
  for (int i = 1;; ++i) {
    Handle(Poly_PolygonOnTriangulation) polygon;
    Handle(Poly_Triangulation) mesh;
    TopLoc_Location place;
    BRep_Tool::PolygonOnTriangulation(edge, polygon, mesh, place, i);
    if (polygon.IsNull()) return {};
    if (!polygon->HasParameters()) continue;
    std::vector<double> t;
    for (int n = 1; n <= polygon->NbNodes(); ++n) t.push_back(polygon->Parameter(n));
    return t;
  }
}

double length_of(const std::vector<gp_Pnt>& points)
{
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += points[i].Distance(points[i - 1]);
  return length;
}

class LoopMaker {
 public:
  LoopMaker(const TopoDS_Face& face, const Closeness& closeness)
      : face_(face), surface_(BRep_Tool::Surface(face)), closeness_(closeness)
  {
    if (surface_->IsUPeriodic()) periods_[0] = surface_->UPeriod();
    if (surface_->IsVPeriodic()) periods_[1] = surface_->VPeriod();
  }

  FaceLoops run()
  {
    for (TopExp_Explorer wires(face_, TopAbs_WIRE); wires.More(); wires.Next()) {
      const std::size_t first = made_.sides.size();
      for (TopExp_Explorer edges(wires.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
        const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
        const bool is_side =
            edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
        if (is_side) made_.sides.push_back(side_of(edge));
      }
      if (made_.sides.size() > first) chains_.push_back(chain(first));
    }
    set_scales();
    for (const auto& chain : chains_) {
      if (!add_loop(chain)) return {std::move(made_.sides), std::move(made_.uv), {}};
    }
    return std::move(made_);
  }

 private:
  using Chain = std::vector<std::size_t>;  // Sides, one after the other.

  struct Corner {
    TopoDS_Vertex vertex{};
    LocalIndex node = kNoIndex;
    double interval = 0.0;  // To the next point of its side.
  };

  [[nodiscard]] FaceSide side_of(const TopoDS_Edge& edge) const
  {
    FaceSide side{.edge = edge};
    double first = 0.0;
    double last = 0.0;
    const auto on_surface = BRep_Tool::CurveOnSurface(edge, face_, first, last);
    side.t = shared_parameters(edge);
    if (side.t.empty() && BRep_Tool::Degenerated(edge)) {
      constexpr int kIntervals = 16;
      side.t = evenly(first, last, kIntervals);
    } else if (side.t.empty()) {
      const BRepAdaptor_Curve curve(edge);
      const GCPnts_TangentialDeflection points(curve, closeness_.angle, closeness_.deflection);
      for (int i = 1; i <= points.NbPoints(); ++i) side.t.push_back(points.Parameter(i));
    }
    for (const double t : side.t) {
      if (on_surface.IsNull()) break;
      const gp_Pnt2d uv = on_surface->Value(t);
      side.uv.push_back({uv.X(), uv.Y()});
    }
    mend(side);
    return side;
  }

  // A seam is left alone: projection cannot tell its sides.
  void mend(FaceSide& side) const
  {
    if (BRep_Tool::Degenerated(side.edge) || BRep_Tool::IsClosed(side.edge, face_)) return;
    const BRepAdaptor_Curve curve(side.edge);
    std::vector<gp_Pnt> points;
    for (const double t : side.t) points.push_back(curve.Value(t));
    double off = side.uv.empty() ? std::numeric_limits<double>::infinity() : 0.0;
    for (std::size_t i = 0; i < side.uv.size(); ++i) {
      off = std::max(off, points[i].Distance(surface_->Value(side.uv[i][0], side.uv[i][1])));
    }
    if (off <= kMostOff * length_of(points)) return;
    ShapeAnalysis_Surface projection(surface_);
    side.uv.clear();
    for (const gp_Pnt& point : points) {
      const double tolerance = BRep_Tool::Tolerance(face_);
      const gp_Pnt2d uv =
          side.uv.empty()
              ? projection.ValueOfUV(point, tolerance)
              : projection.NextValueOfUV({side.uv.back()[0], side.uv.back()[1]}, point, tolerance);
      const Point found{uv.X(), uv.Y()};
      side.uv.push_back(side.uv.empty() ? found : near(found, side.uv.back()));
    }
  }

  // The same place of a periodic surface, as near to another one as can be.
  [[nodiscard]] Point near(Point uv, const Point& other) const
  {
    for (std::size_t k = 0; k < 2; ++k) {
      if (periods_[k] > 0.0) uv[k] += periods_[k] * std::round((other[k] - uv[k]) / periods_[k]);
    }
    return uv;
  }

  [[nodiscard]] static bool is_forward(const FaceSide& side)
  {
    return side.edge.Orientation() == TopAbs_FORWARD;
  }
  [[nodiscard]] static const Point& start(const FaceSide& side)
  {
    return is_forward(side) ? side.uv.front() : side.uv.back();
  }
  [[nodiscard]] static const Point& end(const FaceSide& side)
  {
    return is_forward(side) ? side.uv.back() : side.uv.front();
  }

  // Sides from `first` on, each after the one that ends at its start; whole periods are taken out.
  [[nodiscard]] Chain chain(std::size_t first)
  {
    Chain chain{first};
    Chain rest(made_.sides.size() - first - 1);
    std::iota(rest.begin(), rest.end(), first + 1);
    while (!rest.empty()) {
      const FaceSide& before = made_.sides[chain.back()];
      const auto cost = [&](std::size_t s) {
        const FaceSide& side = made_.sides[s];
        const bool meets = TopExp::LastVertex(before.edge, Standard_True)
                               .IsSame(TopExp::FirstVertex(side.edge, Standard_True));
        const double gap =
            std::hypot(start(side)[0] - end(before)[0], start(side)[1] - end(before)[1]);
        return std::pair{meets ? 0 : 1, gap};
      };
      const auto next = std::ranges::min_element(rest, {}, cost);
      FaceSide& side = made_.sides[*next];
      const Point from = start(side);
      const Point to = near(from, end(before));
      for (Point& uv : side.uv) uv = {uv[0] + to[0] - from[0], uv[1] + to[1] - from[1]};
      chain.push_back(*next);
      rest.erase(next);
    }
    return chain;
  }

  // What a parameter is worth in lengths, so that gaps can be told from intervals.
  void set_scales()
  {
    std::vector<Point> uv;
    for (const FaceSide& side : made_.sides) uv.insert(uv.end(), side.uv.begin(), side.uv.end());
    const std::array<double, 2> speeds = parameter_speeds(surface_, uv);
    for (std::size_t k = 0; k < 2; ++k) {
      if (speeds[k] > 0.0) scale_[k] = speeds[k];
    }
  }

  [[nodiscard]] double distance(const Point& a, const Point& b) const
  {
    return std::hypot(scale_[0] * (a[0] - b[0]), scale_[1] * (a[1] - b[1]));
  }

  // From one end of a side, which is in row `place`, to the next point.
  [[nodiscard]] double interval_at(const FaceSide& side, std::size_t place) const
  {
    return distance(side.uv[place], side.uv[place == 0 ? 1 : place - 1]);
  }

  [[nodiscard]] bool is_same_corner(const FaceSide& before, const FaceSide& after) const
  {
    const double last = interval_at(before, is_forward(before) ? before.uv.size() - 1 : 0);
    const double next = interval_at(after, is_forward(after) ? 0 : after.uv.size() - 1);
    return distance(end(before), start(after)) <= kSameCorner * std::min(last, next);
  }

  bool add_loop(const Chain& chain)
  {
    geometry::PlaneMesh::Loop loop;
    const auto& sides = made_.sides;
    const auto has_few = [&](std::size_t s) { return sides[s].uv.size() < 2; };
    if (std::ranges::any_of(chain, has_few)) return false;
    const FaceSide& last = sides[chain.back()];
    const FaceSide& first = sides[chain.front()];
    for (std::size_t k = 0; k < 2; ++k) {
      if (periods_[k] > 0.0 && std::abs(end(last)[k] - start(first)[k]) > 0.5 * periods_[k])
        return false;
    }
    std::vector<char> joins_next;  // For each side, whether its end is the next one's start.
    for (std::size_t i = 0; i < chain.size(); ++i) {
      joins_next.push_back(is_same_corner(sides[chain[i]], sides[chain[(i + 1) % chain.size()]]));
    }
    // Of a face as narrow as its tolerance nothing would be left.
    const bool has_few_points = num_points(chain) < 3 + chain.size();
    if (has_few_points) joins_next.assign(chain.size(), 0);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const bool joins = i > 0 && joins_next[i - 1] != 0;
      const bool ends_at_first = i + 1 == chain.size() && joins_next[i] != 0;
      add_side(made_.sides[chain[i]], joins, ends_at_first, has_few_points, loop);
    }
    if (loop.size() < 3) return false;
    made_.loops.push_back(std::move(loop));
    return true;
  }

  [[nodiscard]] std::size_t num_points(const Chain& chain) const
  {
    std::size_t count = 0;
    for (const std::size_t s : chain) count += made_.sides[s].uv.size();
    return count;
  }

  void add_side(FaceSide& side, bool joins, bool ends_at_first, bool has_few_points,
                geometry::PlaneMesh::Loop& loop)
  {
    const std::size_t count = side.uv.size();
    side.nodes.assign(count, kNoIndex);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = is_forward(side) ? i : count - 1 - i;
      LocalIndex& node = side.nodes[place];
      if (i == 0 && joins) {
        node = loop.back();
      } else if (i + 1 == count && ends_at_first) {
        node = loop.front();
      } else {
        const bool may_touch = !has_few_points && (i == 0 || i + 1 == count);
        node = may_touch ? corner_node(side, place) : add_node(side.uv[place]);
        loop.push_back(node);
      }
    }
  }

  LocalIndex add_node(const Point& uv)
  {
    made_.uv.push_back(uv);
    return static_cast<LocalIndex>(made_.uv.size()) - 1;
  }

  // Where loops touch they have one node. The two ends of a seam are one vertex and two places.
  LocalIndex corner_node(const FaceSide& side, std::size_t place)
  {
    const TopoDS_Vertex vertex =
        place == 0 ? TopExp::FirstVertex(side.edge) : TopExp::LastVertex(side.edge);
    const double interval = interval_at(side, place);
    const auto is_here = [&](const Corner& corner) {
      return corner.vertex.IsSame(vertex)
             && distance(made_.uv[at(corner.node)], side.uv[place])
                    <= kSameCorner * std::min(corner.interval, interval);
    };
    const auto known = std::ranges::find_if(corners_, is_here);
    if (known != corners_.end()) return known->node;
    corners_.push_back({vertex, add_node(side.uv[place]), interval});
    return corners_.back().node;
  }

  TopoDS_Face face_;
  Handle(Geom_Surface) surface_;
  Closeness closeness_;
  std::array<double, 2> periods_{};
  std::array<double, 2> scale_{1.0, 1.0};
  std::vector<Chain> chains_{};
  std::vector<Corner> corners_{};
  FaceLoops made_{};
};

}  // namespace

FaceLoops loops_of(const TopoDS_Face& face, const Closeness& closeness)
{
  return LoopMaker(face, closeness).run();
}

std::array<double, 2> parameter_speeds(const Handle(Geom_Surface) & surface,
                                       const std::vector<Point>& uv)
{
  std::array<double, 2> sum{};
  for (const Point& at_point : uv) {
    gp_Pnt point;
    gp_Vec by_u;
    gp_Vec by_v;
    surface->D1(at_point[0], at_point[1], point, by_u, by_v);
    sum[0] += by_u.SquareMagnitude();
    sum[1] += by_v.SquareMagnitude();
  }
  const auto speed = [&](double total) {
    return total > 0.0 ? std::sqrt(total / static_cast<double>(uv.size())) : 0.0;
  };
  return {speed(sum[0]), speed(sum[1])};
}

}  // namespace tessera::cad
