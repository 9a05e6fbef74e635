// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/child_energy.hpp"

#include <cmath>

namespace tessera::coarse {
namespace {

// Of the 4^3 children of two levels 24 have the shape of their tet, of the 8^3 of three levels 176:
// 0.375 and 0.344. The limit is a third.
constexpr double kShareOfOwnShape = 0.36;

// eta^-3 = S^3 / (432 w^2): S the sum of the squared edges, w six times the volume of either sign.
double energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 q = d - a;
  const Vec3 sum = u + v + q;
  const double w = dot(u, cross(v, q));
  const double s = 4.0 * (dot(u, u) + dot(v, v) + dot(q, q)) - dot(sum, sum);
  return w != 0.0 ? s * s * s / (432.0 * w * w) : kNoTet;
}

struct Octahedron {
  Vec3 from{};  // Ends of the shortest diagonal.
  Vec3 to{};
  std::array<Vec3, 4> ring{};
};

Octahedron inner_octahedron(const std::array<Vec3, 4>& p)
{
  double shortest = kNoTet;
  Octahedron found;
  for (std::size_t i = 1; i < 4; ++i) {
    const std::size_t j = i % 3 + 1;
    const std::size_t k = j % 3 + 1;
    const Vec3 from = midpoint(p[0], p[i]);
    const Vec3 to = midpoint(p[j], p[k]);
    const double squared = dot(to - from, to - from);
    if (squared >= shortest) continue;
    shortest = squared;
    found = {
        from,
        to,
        {midpoint(p[0], p[j]), midpoint(p[0], p[k]), midpoint(p[i], p[k]), midpoint(p[i], p[j])}};
  }
  return found;
}

}  // namespace

double child_energy(const std::array<Vec3, 4>& corners)
{
  const auto& [a, b, c, d] = corners;
  if (!(tet_volume(a, b, c, d) > 0.0)) return kNoTet;
  const Octahedron inner = inner_octahedron(corners);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += energy(inner.from, inner.to, inner.ring[i], inner.ring[(i + 1) % 4]);
  }
  return kShareOfOwnShape * energy(a, b, c, d) + (1.0 - kShareOfOwnShape) * 0.25 * sum;
}

}  // namespace tessera::coarse
