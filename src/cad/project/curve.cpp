// SPDX-License-Identifier: BSD-3-Clause
#include "cad/project/curve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <BRep_Tool.hxx>
#include <BndLib_Add3dCurve.hxx>
#include <GeomAbs_CurveType.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include "cad/project/descent.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Healing states tolerances of the size of the model where it finds no way to close a gap. A vertex
// that is farther off than this part of the box diagonal is a defect, whatever the file says.
constexpr double kMostRelativeTolerance = 1e-3;

// OpenCASCADE samples some kinds of curves for their boxes. By this part of its diagonal a box is
// made larger, so that it holds what lies between samples.
constexpr double kBoxMargin = 0.1;

// Enough starts that two extrema between neighbouring samples are unlikely: several a span.
int sample_count(const Handle(Geom_Curve) & curve, double first, double last)
{
  const GeomAdaptor_Curve adaptor(curve, first, last);
  switch (adaptor.GetType()) {
    case GeomAbs_Line:
      return 2;
    case GeomAbs_BSplineCurve:
    case GeomAbs_BezierCurve:
      return std::clamp(4 * adaptor.NbIntervals(GeomAbs_C2) + adaptor.Degree(), 16, 256);
    default:
      return 24;
  }
}

}  // namespace

OccCurve::OccCurve(const TopoDS_Edge& edge, double box_diagonal)
    : curve_(BRep_Tool::Curve(edge, first_, last_)),
      tolerance_(std::max(BRep_Tool::Tolerance(edge), kMinRelativeTolerance * box_diagonal)),
      box_diagonal_(box_diagonal)
{
  if (curve_.IsNull()) throw GeometryError("an edge of the model has no curve in space");
  samples_.resize(static_cast<std::size_t>(sample_count(curve_, first_, last_)) + 1);
  for (std::size_t i = 0; i < samples_.size(); ++i)
    samples_[i] = curve_->Value(sample_parameter(i));
  BndLib_Add3dCurve::Add(GeomAdaptor_Curve(curve_, first_, last_), 0.0, box_);
  box_.Enlarge(kBoxMargin * std::sqrt(box_.SquareExtent()));
  for (TopExp_Explorer vertices(edge, TopAbs_VERTEX); vertices.More(); vertices.Next()) {
    const TopoDS_Vertex& vertex = TopoDS::Vertex(vertices.Current());
    const double tolerance =
        std::min(BRep_Tool::Tolerance(vertex), kMostRelativeTolerance * box_diagonal);
    ends_.push_back({from_occ(BRep_Tool::Pnt(vertex)), tolerance});
  }
}

double OccCurve::end_tolerance(const Vec3& point) const
{
  double tolerance = tolerance_;
  for (const End& end : ends_) {
    if (norm(end.point - point) <= end.tolerance) tolerance = std::max(tolerance, end.tolerance);
  }
  return tolerance;
}

model::CurvePoint OccCurve::project(const Vec3& point, double guess) const
{
  const Descent local = descend(point, guess);
  return local.converged ? local.point : nearest(point);
}

model::CurvePoint OccCurve::locate(const Vec3& point, double guess) const
{
  const Descent local = descend(point, guess);
  if (local.converged && local.distance <= tolerance_) return local.point;
  const model::CurvePoint global = nearest(point);
  return norm(global.xyz - point) < local.distance ? global : local.point;
}

model::CurvePoint OccCurve::nearest(const Vec3& point) const
{
  // Samples that are nearer than their neighbours start a descent; the ends are candidates.
  const gp_Pnt target = to_occ(point);
  std::vector<double> distances;
  for (const gp_Pnt& sample : samples_) distances.push_back(sample.Distance(target));
  Descent best;
  best.distance = kFarAway;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const bool below_left = i == 0 || distances[i] <= distances[i - 1];
    const bool below_right = i + 1 == samples_.size() || distances[i] <= distances[i + 1];
    if (!below_left || !below_right) continue;
    const Descent candidate = descend(point, sample_parameter(i));
    if (candidate.distance < best.distance - kTieDistance * box_diagonal_) best = candidate;
  }
  return best.point;
}

double OccCurve::sample_parameter(std::size_t i) const
{
  return first_
         + (last_ - first_) * static_cast<double>(i) / static_cast<double>(samples_.size() - 1);
}

bool OccCurve::is_within(double distance, const Vec3& point) const
{
  Bnd_Box near(box_);
  near.Enlarge(distance);
  return !near.IsOut(to_occ(point)) && norm(nearest(point).xyz - point) <= distance;
}

OccCurve::Descent OccCurve::descend(const Vec3& point, double guess) const
{
  const gp_Pnt target = to_occ(point);
  const auto found = cad::descend(
      evaluate(target, guess), box_diagonal_,
      [&](const Evaluation& here) { return step_at(target, here); },
      [&](const Evaluation& here, const Step& step, double fraction) {
        return evaluate(target, here.t + fraction * step.t);
      });
  return {{from_occ(found.end.value), found.end.t}, found.end.distance, found.converged};
}

OccCurve::Evaluation OccCurve::evaluate(const gp_Pnt& target, double t) const
{
  Evaluation here{.t = std::clamp(t, first_, last_)};
  curve_->D2(here.t, here.value, here.first_derivative, here.second_derivative);
  here.distance = here.value.Distance(target);
  return here;
}

// Newton's step for the squared distance; Gauss-Newton's where that is no descent direction. There
// the distance may be the largest instead of the smallest: opposite to the point on a closed curve.
OccCurve::Step OccCurve::step_at(const gp_Pnt& target, const Evaluation& here) const
{
  const gp_Vec offset(target, here.value);
  const double squared_speed = here.first_derivative.SquareMagnitude();
  if (squared_speed <= 0.0) return {.is_valley = true};
  const double gradient = offset.Dot(here.first_derivative);
  const double curvature = squared_speed + offset.Dot(here.second_derivative);
  const double pivot = kMinRelativePivot * squared_speed;
  const double limit = kMaxStepFraction * (last_ - first_);
  const double newton = -gradient / (curvature > pivot ? curvature : squared_speed);
  const double step = std::clamp(newton, -limit, limit);
  const double moved = std::clamp(here.t + step, first_, last_) - here.t;
  return {step, std::abs(moved) * std::sqrt(squared_speed), curvature > -pivot};
}

}  // namespace tessera::cad
