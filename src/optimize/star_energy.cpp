// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/star_energy.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// A tet with its first corner at the point.
struct Tet {
  Vec3 opposite;   // Sum of the edges from the point.
  Vec3 inward;     // Gradient of w.
  double squares;  // Sum of all squared edges.
  double w;        // Six times the volume.

  Tet(const std::array<Vec3, 3>& face, const Vec3& point)
  {
    const Vec3 a = face[0] - point;
    const Vec3 b = face[1] - point;
    const Vec3 c = face[2] - point;
    opposite = a + b + c;
    inward = cross(c - a, b - a);
    squares = 4.0 * (dot(a, a) + dot(b, b) + dot(c, c)) - dot(opposite, opposite);
    w = -dot(inward, a);
  }

  // With w as it is or regularised.
  [[nodiscard]] double energy(double width) const
  {
    return kEnergyFactor * (squares * squares * squares) / (width * width);
  }
};

double root_of(double w, double delta) { return std::sqrt(w * w + 4.0 * delta * delta); }

// A symmetric matrix: xx, xy, xz, yy, yz, zz.
using Symmetric = std::array<double, 6>;

// Adds factor * v v'.
void add_product(Symmetric& matrix, double factor, const Vec3& v)
{
  matrix[0] += factor * v[0] * v[0];
  matrix[1] += factor * v[0] * v[1];
  matrix[2] += factor * v[0] * v[2];
  matrix[3] += factor * v[1] * v[1];
  matrix[4] += factor * v[1] * v[2];
  matrix[5] += factor * v[2] * v[2];
}

// The solution of matrix * x = -g; zero unless the determinant is positive.
Vec3 solve_negative(const Symmetric& m, const Vec3& g)
{
  const Vec3 row0{m[0], m[1], m[2]};
  const Vec3 row1{m[1], m[3], m[4]};
  const Vec3 row2{m[2], m[4], m[5]};
  const Vec3 c0 = cross(row1, row2);
  const double determinant = dot(row0, c0);
  if (!(determinant > 0.0)) return {0.0, 0.0, 0.0};
  const double factor = -1.0 / determinant;
  return factor * (g[0] * c0 + g[1] * cross(row2, row0) + g[2] * cross(row0, row1));
}

}  // namespace

double StarEnergy::worst(const Vec3& point) const
{
  double worst = 0.0;
  for (const auto& face : faces_) {
    const Tet tet(face, point);
    worst = std::max(worst, tet.w > 0.0 ? tet.energy(tet.w) : kInfinity);
  }
  return worst;
}

double StarEnergy::typical_volume(const Vec3& point) const
{
  double squares = 0.0;
  for (const auto& face : faces_) squares += Tet(face, point).squares;
  const double edge = std::sqrt(squares / (6.0 * static_cast<double>(faces_.size())));
  return edge * edge * edge / std::sqrt(2.0);
}

Vec3 StarEnergy::minimize(Vec3 point, double delta, int num_steps) const
{
  constexpr int kTries = 6;
  constexpr double kShorter = 0.35;
  double least = energy(point, delta);
  for (int i = 0; i < num_steps; ++i) {
    Vec3 step = newton_step(point, delta);
    int tries = 0;
    while (tries < kTries && !(energy(point + step, delta) < least)) {
      step = kShorter * step;
      ++tries;
    }
    if (tries == kTries) break;
    point = point + step;
    least = energy(point, delta);
  }
  return point;
}

double StarEnergy::energy(const Vec3& point, double delta) const
{
  double sum = 0.0;
  for (const auto& face : faces_) {
    const Tet tet(face, point);
    sum += tet.energy(0.5 * (tet.w + root_of(tet.w, delta)));
  }
  return sum;
}

// The Hessian is taken as if h were linear: the term that is left out is the only one that could
// make it indefinite.
Vec3 StarEnergy::newton_step(const Vec3& point, double delta) const
{
  Vec3 gradient{};
  Symmetric hessian{};
  for (const auto& face : faces_) {
    const Tet tet(face, point);
    const double root = root_of(tet.w, delta);
    const double f = tet.energy(0.5 * (tet.w + root));
    const Vec3 ds = (-2.0 / tet.squares) * tet.opposite;
    const Vec3 dh = (1.0 / root) * tet.inward;  // h' / h = 1 / root.
    const Vec3 l = 3.0 * ds - 2.0 * dh;
    gradient = gradient + f * l;
    add_product(hessian, f, l);
    add_product(hessian, -3.0 * f, ds);
    add_product(hessian, 2.0 * f, dh);
    for (const std::size_t i : {0U, 3U, 5U}) hessian[i] += 18.0 * f / tet.squares;
  }
  return solve_negative(hessian, gradient);
}

}  // namespace tessera::optimize
