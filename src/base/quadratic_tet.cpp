// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/quadratic_tet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tessera {
namespace {

using Exponents = std::array<int, 4>;
constexpr std::size_t kNumCubics = 20;
constexpr int kDegree = 3;

// How sharp bounds are, as a share of the largest coefficient.
constexpr double kSharpness = 0.01;
// A cubic that is not decided after so many cuts is worth none more: it is not called positive.
constexpr int kMostCuts = 2000;
// Of the product of the three longest derivatives: some hundred roundings of 1e-16.
constexpr double kRounding = 1e-13;

constexpr std::array<Exponents, kNumCubics> make_cubics()
{
  std::array<Exponents, kNumCubics> cubics{};
  std::size_t row = 0;
  for (int d = 0; d <= kDegree; ++d) {
    for (int c = 0; c + d <= kDegree; ++c) {
      for (int b = 0; b + c + d <= kDegree; ++b) cubics[row++] = {kDegree - b - c - d, b, c, d};
    }
  }
  return cubics;
}

constexpr std::array<Exponents, kNumCubics> kCubics = make_cubics();

constexpr std::size_t code_of(const Exponents& e)
{
  return static_cast<std::size_t>(e[1] + 4 * e[2] + 16 * e[3]);
}

constexpr std::array<std::size_t, 64> make_rows()
{
  std::array<std::size_t, 64> rows{};
  for (std::size_t row = 0; row < kNumCubics; ++row) rows[code_of(kCubics[row])] = row;
  return rows;
}

constexpr std::array<std::size_t, 64> kRowOfCode = make_rows();

constexpr std::size_t row_of(const Exponents& e) { return kRowOfCode[code_of(e)]; }

constexpr double multinomial(const Exponents& e)
{
  constexpr std::array<double, 4> kFactorial{1.0, 1.0, 2.0, 6.0};
  double value = kFactorial[kDegree];
  for (const int one : e) value /= kFactorial[static_cast<std::size_t>(one)];
  return value;
}

// Derivatives by the last three barycentric coordinates at the four corners; linear in between.
using Derivatives = std::array<std::array<Vec3, 4>, 3>;

Derivatives derivatives_of(const QuadraticTet& tet)
{
  std::array<std::array<Vec3, 4>, 4> control{};
  for (std::size_t c = 0; c < 4; ++c) control[c][c] = tet[c];
  for (std::size_t e = 0; e < kQuadraticTetEdges.size(); ++e) {
    const auto [a, b] = kQuadraticTetEdges[e];
    control[a][b] = 2.0 * tet[4 + e] - midpoint(tet[a], tet[b]);
    control[b][a] = control[a][b];
  }
  Derivatives derivatives{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      derivatives[k][i] = 2.0 * (control[i][k + 1] - control[i][0]);
    }
  }
  return derivatives;
}

double rounding_of(const Derivatives& derivatives)
{
  double product = kRounding;
  for (const auto& at_corners : derivatives) {
    double longest = 0.0;
    for (const Vec3& one : at_corners) longest = std::max(longest, norm(one));
    product *= longest;
  }
  return product;
}

JacobianCoefficients coefficients_of(const Derivatives& d)
{
  JacobianCoefficients sums{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 normal = cross(d[0][i], d[1][j]);
      for (std::size_t k = 0; k < 4; ++k) {
        Exponents e{};
        ++e[i];
        ++e[j];
        ++e[k];
        sums[row_of(e)] += dot(normal, d[2][k]);
      }
    }
  }
  for (std::size_t row = 0; row < kNumCubics; ++row) sums[row] /= multinomial(kCubics[row]);
  return sums;
}

// A cubic on a part of the tet.
struct Part {
  JacobianCoefficients coefficients{};
  std::array<Vec3, 4> corners{};  // In the regular tet: the longest edge is cut.

  [[nodiscard]] double lower() const { return *std::ranges::min_element(coefficients); }
};

bool has_larger_lower(const Part& a, const Part& b) { return a.lower() > b.lower(); }

// At corners the cubic has the value of the coefficient.
double least_at_corners(const JacobianCoefficients& c)
{
  return std::min({c[row_of({3, 0, 0, 0})], c[row_of({0, 3, 0, 0})], c[row_of({0, 0, 3, 0})],
                   c[row_of({0, 0, 0, 3})]});
}

// De Casteljau's algorithm at the middle of the edge from a to b. @return The half with corner
// `keep`, which is a or b; the middle takes the place of the other.
JacobianCoefficients half_of(const JacobianCoefficients& whole, std::size_t keep, std::size_t other)
{
  JacobianCoefficients half{};
  for (std::size_t row = 0; row < kNumCubics; ++row) {
    Exponents e = kCubics[row];
    const int steps = e[other];
    e[other] = 0;
    constexpr std::array<std::array<double, 4>, 4> kWeights{
        {{1.0}, {0.5, 0.5}, {0.25, 0.5, 0.25}, {0.125, 0.375, 0.375, 0.125}}};
    for (int i = 0; i <= steps; ++i) {
      Exponents from = e;
      from[keep] += steps - i;
      from[other] += i;
      half[row] += kWeights[static_cast<std::size_t>(steps)][static_cast<std::size_t>(i)]
                   * whole[row_of(from)];
    }
  }
  return half;
}

std::array<std::size_t, 2> longest_edge(const std::array<Vec3, 4>& corners)
{
  return *std::ranges::max_element(kQuadraticTetEdges, {}, [&](const auto& edge) {
    const Vec3 along = corners[edge[1]] - corners[edge[0]];
    return dot(along, along);
  });
}

std::array<Part, 2> halves_of(const Part& part)
{
  const auto [a, b] = longest_edge(part.corners);
  std::array<Part, 2> halves{{{half_of(part.coefficients, a, b), part.corners},
                              {half_of(part.coefficients, b, a), part.corners}}};
  const Vec3 middle = midpoint(part.corners[a], part.corners[b]);
  halves[0].corners[b] = middle;
  halves[1].corners[a] = middle;
  return halves;
}

// A lower bound of a cubic. The part with the lowest coefficient is cut until that is close to a
// value of the cubic, or there is a value that is not above `floor`.
double lower_bound_of(const JacobianCoefficients& cubic, double floor)
{
  double largest = 0.0;
  for (const double c : cubic) largest = std::max(largest, std::abs(c));
  double least_value = least_at_corners(cubic);
  std::vector<Part> parts{
      {cubic, {{{1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}}}}};
  for (int cut = 0; cut < kMostCuts; ++cut) {
    const double lower = parts.front().lower();
    const bool is_decided = lower > floor || least_value <= floor;
    if (is_decided && least_value - lower <= kSharpness * largest) break;
    std::ranges::pop_heap(parts, has_larger_lower);
    const Part part = parts.back();
    parts.pop_back();
    for (const Part& half : halves_of(part)) {
      least_value = std::min(least_value, least_at_corners(half.coefficients));
      parts.push_back(half);
      std::ranges::push_heap(parts, has_larger_lower);
    }
  }
  return parts.front().lower();
}

}  // namespace

const std::array<std::array<int, 4>, 20>& cubic_indices() noexcept { return kCubics; }

std::size_t row_of_edge(std::size_t a, std::size_t b) noexcept
{
  const std::array sorted{std::min(a, b), std::max(a, b)};
  return static_cast<std::size_t>(std::ranges::find(kQuadraticTetEdges, sorted)
                                  - kQuadraticTetEdges.begin());
}

std::vector<LocalIndex> with_nodes(std::vector<LocalIndex> corners, std::size_t num_corners,
                                   const std::vector<LocalIndex>& nodes, std::size_t num_nodes)
{
  if (nodes.empty()) return corners;
  std::vector<LocalIndex> both;
  both.reserve(corners.size() + nodes.size());
  for (std::size_t cell = 0; num_nodes * cell < nodes.size(); ++cell) {
    both.insert(both.end(), &corners[num_corners * cell],
                &corners[num_corners * cell] + num_corners);
    both.insert(both.end(), &nodes[num_nodes * cell], &nodes[num_nodes * cell] + num_nodes);
  }
  return both;
}

bool is_straight(const QuadraticTet& tet) noexcept
{
  for (std::size_t e = 0; e < kQuadraticTetEdges.size(); ++e) {
    const auto [a, b] = kQuadraticTetEdges[e];
    if (tet[4 + e] != midpoint(tet[a], tet[b])) return false;
  }
  return true;
}

JacobianCoefficients jacobian_coefficients(const QuadraticTet& tet) noexcept
{
  return coefficients_of(derivatives_of(tet));
}

double curved_volume(const QuadraticTet& tet) noexcept
{
  if (is_straight(tet)) return tet_volume(tet[0], tet[1], tet[2], tet[3]);
  double sum = 0.0;
  for (const double c : jacobian_coefficients(tet)) sum += c;
  return sum / (6.0 * static_cast<double>(kNumCubics));
}

JacobianBounds jacobian_bounds(const QuadraticTet& tet)
{
  if (is_straight(tet)) {
    const double determinant = 6.0 * tet_volume(tet[0], tet[1], tet[2], tet[3]);
    return {determinant, determinant};
  }
  const Derivatives derivatives = derivatives_of(tet);
  const double rounding = rounding_of(derivatives);
  JacobianCoefficients cubic = coefficients_of(derivatives);
  const bool is_finite = std::ranges::all_of(cubic, [](double c) { return std::isfinite(c); });
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!is_finite) return {-kInfinity, kInfinity};
  JacobianBounds bounds;
  bounds.smallest = lower_bound_of(cubic, rounding) - rounding;
  for (double& c : cubic) c = -c;
  bounds.largest = rounding - lower_bound_of(cubic, -kInfinity);
  return bounds;
}

}  // namespace tessera
