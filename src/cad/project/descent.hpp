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

}  // namespace tessera::cad
