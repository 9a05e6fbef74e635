// SPDX-License-Identifier: BSD-3-Clause
#include "cut/moments.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tessera/base/box.hpp"

namespace tessera::cut {
namespace {

using Matrix = std::array<Vec3, 3>;

// Makes matrix[p][q] zero (a Jacobi rotation). The columns of `axes` turn with it.
void rotate(Matrix& matrix, Matrix& axes, std::size_t p, std::size_t q)
{
  const double theta = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0);
  const double s = t * c;
  const auto turn = [&](double& a, double& b) {
    std::tie(a, b) = std::pair(c * a - s * b, s * a + c * b);
  };
  for (std::size_t k = 0; k < 3; ++k) turn(matrix[k][p], matrix[k][q]);
  for (std::size_t k = 0; k < 3; ++k) turn(matrix[p][k], matrix[q][k]);
  for (std::size_t k = 0; k < 3; ++k) turn(axes[k][p], axes[k][q]);
}

// Mean of a triangle's distances below a plane, which are 0 above it.
double mean_depth(std::array<double, 3> h)
{
  std::ranges::sort(h);
  const double mean = (h[0] + h[1] + h[2]) / 3.0;
  if (h[2] <= 0.0) return -mean;
  if (h[0] >= 0.0) return 0.0;
  if (h[1] >= 0.0) return -h[0] * h[0] * h[0] / (3.0 * (h[1] - h[0]) * (h[2] - h[0]));
  return -mean + h[2] * h[2] * h[2] / (3.0 * (h[2] - h[0]) * (h[2] - h[1]));
}

Vec3 middle_of_box(const PartSurface& part)
{
  const Box box = bounding_box(part.points);
  return midpoint(box.low, box.high);
}

}  // namespace

Vec3 turned_forward(const Vec3& direction)
{
  // Of components that are equal but for rounding, the first decides.
  std::size_t largest = 0;
  for (std::size_t d = 1; d < 3; ++d) {
    if (std::abs(direction[d]) > std::abs(direction[largest]) + 1e-9) largest = d;
  }
  return direction[largest] < 0.0 ? -1.0 * direction : direction;
}

Eigen eigen_of(const Symmetric& matrix)
{
  const auto& [xx, xy, xz, yy, yz, zz] = matrix;
  Matrix m{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
  Matrix axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  // What is off the diagonal by rounding alone must not turn equal axes.
  const double noise = 1e-10 * (std::abs(xx) + std::abs(yy) + std::abs(zz));
  constexpr std::array<std::array<std::size_t, 2>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};
  for (int sweep = 0; sweep < 50; ++sweep) {
    for (const auto& [p, q] : kPairs) {
      if (std::abs(m[p][q]) > noise) rotate(m, axes, p, q);
    }
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{0}}) {
    if (m[order[i + 1]][order[i + 1]] > m[order[i]][order[i]] + 10.0 * noise) {
      std::swap(order[i], order[i + 1]);
    }
  }
  Eigen eigen;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = order[i];
    eigen.values[i] = m[k][k];
    eigen.axes[i] = turned_forward({axes[0][k], axes[1][k], axes[2][k]});
  }
  return eigen;
}

Moments moments_of(const PartSurface& part)
{
  Moments moments;
  if (part.points.empty()) return moments;
  const Vec3 origin = middle_of_box(part);
  Vec3 first{};
  Symmetric second{};
  part.for_each_triangle([&](LocalIndex i, LocalIndex j, LocalIndex k) {
    const std::array p{part.points[at(i)] - origin, part.points[at(j)] - origin,
                       part.points[at(k)] - origin};
    const double volume = dot(cross(p[0], p[1]), p[2]) / 6.0;
    const Vec3 sum = p[0] + p[1] + p[2];
    moments.volume += volume;
    first = first + 0.25 * volume * sum;
    std::size_t row = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a; b < 3; ++b) {
        second[row++] +=
            volume / 20.0
            * (sum[a] * sum[b] + p[0][a] * p[0][b] + p[1][a] * p[1][b] + p[2][a] * p[2][b]);
      }
    }
  });
  if (!(moments.volume > 0.0)) return moments;
  const Vec3 centre = (1.0 / moments.volume) * first;
  std::size_t row = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) second[row++] -= moments.volume * centre[a] * centre[b];
  }
  moments.centre = origin + centre;
  moments.axes = eigen_of(second).axes;
  return moments;
}

double volume_of(const PartSurface& part)
{
  if (part.points.empty()) return 0.0;
  const Vec3 origin = middle_of_box(part);
  double volume = 0.0;
  part.for_each_triangle([&](LocalIndex i, LocalIndex j, LocalIndex k) {
    volume += tet_volume(origin, part.points[at(i)], part.points[at(j)], part.points[at(k)]);
  });
  return volume;
}

double volume_below(const PartSurface& part, const Vec3& normal, const std::vector<double>& heights)
{
  // The divergence theorem for the field that points along the normal and grows with depth: what
  // flows through the surface below the plane. The cut itself adds nothing: its depth is 0.
  double volume = 0.0;
  part.for_each_triangle([&](LocalIndex i, LocalIndex j, LocalIndex k) {
    const double depth = mean_depth({heights[at(i)], heights[at(j)], heights[at(k)]});
    if (depth == 0.0) return;
    const Vec3& p = part.points[at(i)];
    volume -= 0.5 * dot(normal, cross(part.points[at(j)] - p, part.points[at(k)] - p)) * depth;
  });
  return volume;
}

double balanced_offset(const PartSurface& part, const Vec3& normal, double fraction)
{
  const std::vector<double> heights = part.heights({normal, 0.0});
  const auto [low, high] = std::ranges::minmax(heights);
  double from = low;
  double to = high;
  const double wanted = fraction * volume_of(part);
  std::vector<double> shifted(heights.size());
  for (int step = 0; step < 40; ++step) {
    const double offset = 0.5 * (from + to);
    std::ranges::transform(heights, shifted.begin(), [&](double h) { return h - offset; });
    (volume_below(part, normal, shifted) < wanted ? from : to) = offset;
  }
  return 0.5 * (from + to);
}

}  // namespace tessera::cut
