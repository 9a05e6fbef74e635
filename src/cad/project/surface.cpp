// SPDX-License-Identifier: BSD-3-Clause
#include "cad/project/surface.hpp"

#include <algorithm>
#include <cmath>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomAbs_SurfaceType.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "cad/project/descent.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Enough starts that two extrema between neighbouring samples are unlikely.
std::array<int, 2> sample_counts(const Handle(Geom_Surface) & surface)
{
  const GeomAdaptor_Surface adaptor(surface);
  switch (adaptor.GetType()) {
    case GeomAbs_Plane:
      return {1, 1};
    case GeomAbs_BSplineSurface:
    case GeomAbs_BezierSurface:
      return {std::clamp(3 * adaptor.NbUIntervals(GeomAbs_C2) + adaptor.UDegree(), 8, 64),
              std::clamp(3 * adaptor.NbVIntervals(GeomAbs_C2) + adaptor.VDegree(), 8, 64)};
    default:
      return {16, 16};
  }
}

// Half the squared distance up to second order around a point of the surface.
struct Quadratic {
  double uu = 0.0;
  double vv = 0.0;
  double uv = 0.0;
  std::array<double, 2> gradient{};

  [[nodiscard]] double determinant() const { return uu * vv - uv * uv; }

  // Takes direction `k` out: its step becomes 0.
  void fix(std::size_t k)
  {
    (k == 0 ? uu : vv) = 1.0;
    uv = 0.0;
    gradient[k] = 0.0;
  }

  [[nodiscard]] std::array<double, 2> minimum() const
  {
    return {(-gradient[0] * vv + gradient[1] * uv) / determinant(),
            (-gradient[1] * uu + gradient[0] * uv) / determinant()};
  }
};

// Whether it curves upwards. Where a guess is on the far side of a closed face, as across its seam,
// the distance has no slope there either, but is the largest and not the smallest.
bool is_convex(const Quadratic& newton, const Quadratic& gauss_newton)
{
  return newton.uu > -kMinRelativePivot * gauss_newton.uu
         && newton.vv > -kMinRelativePivot * gauss_newton.vv
         && newton.determinant() > -kMinRelativePivot * gauss_newton.uu * gauss_newton.vv;
}

// Newton's step; Gauss-Newton's where that is no descent; each direction by itself where both are
// singular.
std::array<double, 2> newton_step(const Quadratic& newton, const Quadratic& gauss_newton)
{
  const double scale = gauss_newton.uu * gauss_newton.vv;
  if (newton.uu > 0.0 && newton.determinant() > kMinRelativePivot * scale) return newton.minimum();
  if (gauss_newton.determinant() > kMinRelativePivot * scale) return gauss_newton.minimum();
  return {-0.5 * gauss_newton.gradient[0] / gauss_newton.uu,
          -0.5 * gauss_newton.gradient[1] / gauss_newton.vv};
}

// How far apart in parameters the two sides of an edge are along which the face meets itself.
std::array<double, 2> seam_width(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
  if (!BRep_Tool::IsClosed(edge, face)) return {};
  double first = 0.0;
  double last = 0.0;
  const auto here = BRep_Tool::CurveOnSurface(edge, face, first, last);
  const auto there = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, first, last);
  if (here.IsNull() || there.IsNull()) return {};
  const gp_Vec2d apart(here->Value(first), there->Value(first));
  return {std::abs(apart.X()), std::abs(apart.Y())};
}

// `value` plus the number of periods that brings it nearest to `reference`.
double nearest_period(double value, double reference, double period)
{
  return value + period * std::round((reference - value) / period);
}

}  // namespace

OccSurface::OccSurface(const TopoDS_Face& face, double box_diagonal, int num_faces)
    : surface_(BRep_Tool::Surface(face)),
      tolerance_(std::max(BRep_Tool::Tolerance(face), kMinRelativeTolerance * box_diagonal)),
      box_diagonal_(box_diagonal)
{
  auto& [u, v] = directions_;
  surface_->Bounds(u.domain_first, u.domain_last, v.domain_first, v.domain_last);
  BRepTools::UVBounds(face, u.face_first, u.face_last, v.face_first, v.face_last);
  // A surface that closes without being periodic has a seam as well; it may not be left.
  if (surface_->IsUClosed()) u.period = u.domain_last - u.domain_first;
  if (surface_->IsVClosed()) v.period = v.domain_last - v.domain_first;
  for (const auto& [periodic, direction] :
       {std::pair{surface_->IsUPeriodic(), &u}, std::pair{surface_->IsVPeriodic(), &v}}) {
    if (!periodic) continue;
    direction->domain_first = -kFarAway;
    direction->domain_last = kFarAway;
  }
  trim_ = std::make_unique<OccTrim>(face,
                                    std::array<double, 2>{surface_->IsUPeriodic() ? u.period : 0.0,
                                                          surface_->IsVPeriodic() ? v.period : 0.0},
                                    OccTrim::fewest_cells(num_faces));
  num_samples_ = sample_counts(surface_);
  collect_boundaries(face, box_diagonal);
}

void OccSurface::collect_boundaries(const TopoDS_Face& face, double box_diagonal)
{
  TopTools_IndexedMapOfShape seen;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    if (BRep_Tool::Degenerated(edge) || seen.Contains(edge)) continue;
    seen.Add(edge);
    close_at_seam(seam_width(edge, face));
    double first = 0.0;
    double last = 0.0;
    const auto on_surface = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (!on_surface.IsNull()) boundaries_.push_back({OccCurve(edge, box_diagonal), on_surface});
  }
}

// OpenCASCADE calls a surface open that is cut out of a periodic one, and a spline whose ends meet
// less exactly than it asks for. The face's seam knows better.
void OccSurface::close_at_seam(const std::array<double, 2>& width)
{
  constexpr double kRelativeTolerance = 1e-6;
  for (std::size_t k = 0; k < 2; ++k) {
    Direction& direction = directions_[k];
    const double span = direction.domain_last - direction.domain_first;
    if (direction.period > 0.0 || width[k] == 0.0) continue;
    if (std::abs(width[k] - span) <= kRelativeTolerance * span) direction.period = span;
  }
}

model::SurfacePoint OccSurface::project(const Vec3& point, const Uv& guess) const
{
  const Descent local = descend(point, guess);
  // At a pole all directions but one are frozen, so a descent that ends there may have missed more.
  const bool trusted = local.converged && !local.is_pole;
  if (trusted && within_trim(local.point)) return local.point;
  return nearest(point, guess);
}

model::SurfacePoint OccSurface::locate(const Vec3& point, const Uv& guess) const
{
  const Descent local = descend(point, guess);
  const bool inside = within_trim(local.point);
  if (local.converged && inside && local.distance <= tolerance_) return local.point;
  const model::SurfacePoint global = nearest(point, guess);
  return inside && local.distance <= norm(global.xyz - point) ? local.point : global;
}

OccSurface::Descent OccSurface::descend(const Vec3& point, const Uv& guess) const
{
  const gp_Pnt target = to_occ(point);
  const auto [end, converged] = cad::descend(
      evaluate(target, guess), box_diagonal_,
      [&](const Evaluation& here) { return step_at(target, here); },
      [&](const Evaluation& here, const Step& step, double fraction) {
        return evaluate(target,
                        {here.uv[0] + fraction * step.uv[0], here.uv[1] + fraction * step.uv[1]});
      });
  const bool is_pole = is_degenerate(end.first, 0) || is_degenerate(end.first, 1);
  return {{from_occ(end.value), end.uv}, end.distance, converged, is_pole};
}

OccSurface::Evaluation OccSurface::evaluate(const gp_Pnt& target, const Uv& uv) const
{
  Evaluation here{.uv = clamped(uv)};
  surface_->D2(here.uv[0], here.uv[1], here.value, here.first[0], here.first[1], here.by_uu,
               here.by_vv, here.by_uv);
  here.distance = here.value.Distance(target);
  return here;
}

OccSurface::Step OccSurface::step_at(const gp_Pnt& target, const Evaluation& here) const
{
  const auto& [u, v] = here.first;
  const gp_Vec offset(target, here.value);
  Quadratic gauss_newton{
      u.SquareMagnitude(), v.SquareMagnitude(), u.Dot(v), {offset.Dot(u), offset.Dot(v)}};
  Quadratic newton = gauss_newton;
  newton.uu += offset.Dot(here.by_uu);
  newton.vv += offset.Dot(here.by_vv);
  newton.uv += offset.Dot(here.by_uv);
  for (std::size_t k = 0; k < 2; ++k) {
    const Direction& direction = directions_[k];
    const double slope = gauss_newton.gradient[k];
    const bool at_end = (here.uv[k] <= direction.domain_first && slope > 0.0)
                        || (here.uv[k] >= direction.domain_last && slope < 0.0);
    if (!at_end && !is_degenerate(here.first, k)) continue;
    newton.fix(k);
    gauss_newton.fix(k);
  }
  Uv step = newton_step(newton, gauss_newton);
  for (std::size_t k = 0; k < 2; ++k) {
    const double limit = kMaxStepFraction * directions_[k].span();
    const double factor = std::abs(step[k]) > limit ? limit / std::abs(step[k]) : 1.0;
    step = {factor * step[0], factor * step[1]};
  }
  const Uv next = clamped({here.uv[0] + step[0], here.uv[1] + step[1]});
  const gp_Vec move = u * (next[0] - here.uv[0]) + v * (next[1] - here.uv[1]);
  return {step, move.Magnitude(), is_convex(newton, gauss_newton)};
}

// Whether the parameter leads nowhere, as at a pole. @param[in] first Derivatives.
bool OccSurface::is_degenerate(const std::array<gp_Vec, 2>& first, std::size_t direction) const
{
  return first[direction].Magnitude() * directions_[direction].span()
         <= kPoleLength * box_diagonal_;
}

std::array<bool, 2> OccSurface::degenerate_directions(const Uv& uv) const
{
  gp_Pnt value;
  std::array<gp_Vec, 2> first;
  surface_->D1(uv[0], uv[1], value, first[0], first[1]);
  return {is_degenerate(first, 0), is_degenerate(first, 1)};
}

OccSurface::Uv OccSurface::clamped(const Uv& uv) const
{
  return {std::clamp(uv[0], directions_[0].domain_first, directions_[0].domain_last),
          std::clamp(uv[1], directions_[1].domain_first, directions_[1].domain_last)};
}

// OpenCASCADE's classifier comes last, since it takes long for points near edges.
bool OccSurface::within_trim(const model::SurfacePoint& point) const
{
  return trim_->is_inside_cell(point.uv) || is_on_boundary(point.xyz) || trim_->contains(point.uv);
}

// Trimming edges are only as exact as their tolerance.
bool OccSurface::is_on_boundary(const Vec3& point) const
{
  return std::any_of(boundaries_.begin(), boundaries_.end(), [&](const Boundary& boundary) {
    return boundary.curve.is_within(std::max(tolerance_, boundary.curve.tolerance()), point);
  });
}

model::SurfacePoint OccSurface::nearest(const Vec3& point, const Uv& guess) const
{
  Descent best = nearest_inside(point);
  const Descent boundary = nearest_boundary(point);
  if (boundary.distance < best.distance - kTieDistance * box_diagonal_) best = boundary;
  if (!best.converged) throw GeometryError("no nearest point found on a face of the model");
  for (std::size_t k = 0; k < 2; ++k) {
    best.point.uv[k] = on_branch_of(best.point.uv[k], guess[k], directions_[k]);
  }
  return best.point;
}

OccSurface::Descent OccSurface::nearest_inside(const Vec3& point) const
{
  Descent best{.distance = kFarAway};
  for (const Uv& start : descent_starts(point)) {
    const Descent candidate = descend(point, start);
    if (!candidate.converged) continue;
    if (candidate.distance >= best.distance - kTieDistance * box_diagonal_) continue;
    if (within_trim(candidate.point)) best = candidate;
  }
  return best;
}

OccSurface::Descent OccSurface::nearest_boundary(const Vec3& point) const
{
  Descent best{.distance = kFarAway};
  for (const Boundary& boundary : boundaries_) {
    const model::CurvePoint on_edge = boundary.curve.nearest(point);
    const double distance = norm(on_edge.xyz - point);
    if (distance >= best.distance - kTieDistance * box_diagonal_) continue;
    const gp_Pnt2d uv = boundary.on_surface->Value(on_edge.t);
    best = descend(on_edge.xyz, {uv.X(), uv.Y()});
    best.distance = distance;
    best.converged = true;  // A point of the edge, whatever the descent onto the surface did.
  }
  if (best.converged) best.distance = norm(best.point.xyz - point);
  return best;
}

// The samples of a grid over the face that are nearer than their neighbours.
std::vector<OccSurface::Uv> OccSurface::descent_starts(const Vec3& point) const
{
  const gp_Pnt target = to_occ(point);
  const int rows = num_samples_[0];
  const int columns = num_samples_[1];
  std::vector<double> distances;
  for (const gp_Pnt& sample : samples()) distances.push_back(sample.SquareDistance(target));
  const auto distance_at = [&](int i, int j) {
    const bool outside = i < 0 || j < 0 || i >= rows || j >= columns;
    return outside ? kFarAway : distances[at(i * columns + j)];
  };
  std::vector<Uv> starts;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double here = distance_at(i, j);
      if (here <= distance_at(i - 1, j) && here <= distance_at(i + 1, j)
          && here <= distance_at(i, j - 1) && here <= distance_at(i, j + 1)) {
        starts.push_back(sample_parameters(i, j));
      }
    }
  }
  return starts;
}

OccSurface::Uv OccSurface::sample_parameters(int row, int column) const
{
  const auto& [u, v] = directions_;
  return {u.face_first + u.span() * (row + 0.5) / num_samples_[0],
          v.face_first + v.span() * (column + 0.5) / num_samples_[1]};
}

const std::vector<gp_Pnt>& OccSurface::samples() const
{
  if (!samples_.empty()) return samples_;
  for (int row = 0; row < num_samples_[0]; ++row) {
    for (int column = 0; column < num_samples_[1]; ++column) {
      const Uv uv = sample_parameters(row, column);
      samples_.push_back(surface_->Value(uv[0], uv[1]));
    }
  }
  return samples_;
}

double OccSurface::on_branch_of(double value, double reference, const Direction& direction)
{
  if (direction.period <= 0.0) return value;
  const double moved = nearest_period(value, reference, direction.period);
  const double slack = kSeamFraction * direction.period;
  const bool allowed =
      moved >= direction.domain_first - slack && moved <= direction.domain_last + slack;
  return allowed ? std::clamp(moved, direction.domain_first, direction.domain_last) : value;
}

std::array<OccSurface::Uv, 3> OccSurface::triangle_parameters(
    const std::array<Vec3, 3>& corners, const std::array<Uv, 3>& guesses) const
{
  std::array<Uv, 3> uv{};
  std::array<std::array<bool, 2>, 3> free{};  // Corner, direction: any value does.
  for (std::size_t c = 0; c < 3; ++c) {
    uv[c] = locate(corners[c], guesses[c]).uv;
    free[c] = degenerate_directions(uv[c]);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double*> bound;
    std::vector<double*> unbound;
    for (std::size_t c = 0; c < 3; ++c) (free[c][k] ? unbound : bound).push_back(&uv[c][k]);
    if (bound.empty()) continue;
    unwrap(bound, directions_[k]);
    double mean = 0.0;
    for (const double* value : bound) mean += *value / static_cast<double>(bound.size());
    for (double* value : unbound) *value = mean;
  }
  return uv;
}

// The value farthest from the seam says on which side of it the triangle lies.
void OccSurface::unwrap(std::span<double* const> values, const Direction& direction)
{
  if (direction.period <= 0.0) return;
  const double middle = 0.5 * (direction.face_first + direction.face_last);
  for (double* value : values) *value = on_branch_of(*value, middle, direction);
  const double anchor =
      **std::min_element(values.begin(), values.end(), [middle](const double* a, const double* b) {
        return std::abs(*a - middle) < std::abs(*b - middle);
      });
  for (double* value : values) *value = on_branch_of(*value, anchor, direction);
}

}  // namespace tessera::cad
