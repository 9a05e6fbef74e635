// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::cad {

// The safeguarded Newton descents onto curves and surfaces share these numbers. Lengths are
// fractions of the diagonal of the model's box.
//
// The descents are our own, because OpenCASCADE's Extrema and ShapeAnalysis work on adaptors: see
// OccCurve. Speed and accuracy were not compared with Extrema yet.

/// A CAD entity's tolerance counts at least this much.
inline constexpr double kMinRelativeTolerance = 1e-8;
/// A step this short ends the descent: convergence is quadratic, so the rest is rounding.
inline constexpr double kConvergedStep = 1e-11;
/// A candidate replaces an earlier one only if it is nearer by more than this, so that rounding
/// does not decide between two that are equally near.
inline constexpr double kTieDistance = 1e-12;
/// Longest step, as a fraction of the parameter range: longer ones leave the quadratic model.
inline constexpr double kMaxStepFraction = 0.25;
inline constexpr int kMaxDescentSteps = 60;
inline constexpr int kMaxHalvings = 30;
/// Newton's matrix counts as singular below this fraction of Gauss-Newton's.
inline constexpr double kMinRelativePivot = 1e-3;
/// Distances count as equal below this: a descent must not stop early because rounding hides the
/// last gains, which are quadratically small.
inline constexpr double kRounding = 1e-14;
/// A parameter direction is degenerate (pole, apex) where its whole range is shorter than this.
inline constexpr double kPoleLength = 1e-7;
/// The parameter of a point on a seam may come out past the end of its domain by this, in periods,
/// and is then set to that end: vertices are off their seam by the CAD tolerance.
inline constexpr double kSeamFraction = 1e-4;
inline constexpr double kFarAway = 1e300;

/// @brief Where a descent ended, and whether the distance is smallest there.
template <class Evaluation>
struct Descended {
  Evaluation end{};
  bool converged = false;
};

/// @brief Goes from an evaluation of a curve or surface to the nearest point that steps lead to.
///
/// An evaluation has its `value` in space, its `distance` to the target, and what the next step
/// needs, so each point is evaluated once.
/// @param[in] step_at Gives the step from an evaluation: its `length` in space to first order, and
/// `is_valley`: the distance curves upwards in all directions.
/// @param[in] advance Evaluates a fraction of a step farther.
template <class Evaluation, class StepAt, class Advance>
[[nodiscard]] Descended<Evaluation> descend(Evaluation here, double box_diagonal, StepAt&& step_at,
                                            Advance&& advance)
{
  const double rounding = kRounding * box_diagonal;
  for (int i = 0; i < kMaxDescentSteps; ++i) {
    const auto step = step_at(here);
    if (step.length <= rounding) return {here, step.is_valley};
    double fraction = 1.0;
    Evaluation next = advance(here, step, fraction);
    const auto is_farther = [&] { return next.distance > here.distance + rounding; };
    for (int halvings = 1; halvings < kMaxHalvings && is_farther(); ++halvings) {
      fraction *= 0.5;
      next = advance(here, step, fraction);
    }
    const bool has_stopped = next.value.Distance(here.value) <= kConvergedStep * box_diagonal;
    if (has_stopped && !step.is_valley) return {here, false};
    if (is_farther()) return {here, has_stopped};
    here = next;
    if (has_stopped) return {here, true};
  }
  return {here, false};
}

}  // namespace tessera::cad
