// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "tessera/base/vec3.hpp"
#include "tessera/optimize/optimize.hpp"

#include "optimize/point.hpp"

namespace tessera::optimize {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// eta^-3 = S^3 / (432 w^2): S the sum of the squared edges, w six times the volume.
inline constexpr double kEnergyFactor = 1.0 / 432.0;

// The energy of a tet of this mean ratio. A mean ratio of 0 has none that is finite.
[[nodiscard]] inline double energy_of_mean_ratio(double mean_ratio)
{
  return 1.0 / (mean_ratio * mean_ratio * mean_ratio);
}

// A tet with a higher energy does not count as positive.
inline constexpr double kHighestEnergy =
    1.0 / (kLeastMeanRatio * kLeastMeanRatio * kLeastMeanRatio);

// What swaps and collapses make small: eta^-1.5.
[[nodiscard]] inline double cost_of_energy(double energy) { return std::sqrt(energy); }

// Infinite unless the tet is positive.
[[nodiscard]] inline double tet_energy(const Point& a, const Point& b, const Point& c,
                                       const Point& d)
{
  const Vec3 u = edge(a, b);
  const Vec3 v = edge(a, c);
  const Vec3 q = edge(a, d);
  const Vec3 sum = u + v + q;
  const double w = dot(u, cross(v, q));
  const double s = 4.0 * (dot(u, u) + dot(v, v) + dot(q, q)) - dot(sum, sum);
  return w > 0.0 ? kEnergyFactor * (s * s * s) / (w * w) : kInfinity;
}

}  // namespace tessera::optimize
