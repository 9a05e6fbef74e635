// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::netgen {

// The safeguarded Newton descents onto curves and surfaces share these numbers. Lengths are
// fractions of the diagonal of the model's box.

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
inline constexpr double kFarAway = 1e300;

}  // namespace tessera::netgen
