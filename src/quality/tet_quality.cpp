// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/tet_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::quality {

namespace {

// Two tets at once, one a lane, where T is Lanes; one tet where it is double. The bits are the
// same.
using Lanes = double __attribute__((vector_size(16)));
constexpr std::size_t kNumLanes = 2;

template <class T>
using Point = std::array<T, 3>;

template <class T>
using Corners = std::array<Point<T>, 4>;

template <class T>
Point<T> difference(const Point<T>& a, const Point<T>& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class T>
T dot_of(const Point<T>& a, const Point<T>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Point<T> cross_of(const Point<T>& a, const Point<T>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double root(double a) { return std::sqrt(a); }
Lanes root(Lanes a) { return Lanes{std::sqrt(a[0]), std::sqrt(a[1])}; }

template <class T>
T sum_of_squared_lengths(const Corners<T>& corners)
{
  T sum{};
  for (const auto& [a, b] : mesh::kTetEdgeCorners) {
    const Point<T> edge = difference(corners[b], corners[a]);
    sum += dot_of(edge, edge);
  }
  return sum;
}

double mean_ratio_of(double volume, double squared_lengths)
{
  if (squared_lengths == 0.0) return 0.0;
  const double cube_root = std::cbrt(3.0 * std::abs(volume));
  return std::copysign(12.0 * cube_root * cube_root / squared_lengths, volume);
}

template <class T>
struct Measures {
  T volume;
  T squared_lengths;
  T largest_cosine;
  T smallest_cosine;
  decltype(T{} > T{}) has_areas;  // All four faces; else there are no cosines.
};

template <class T>
Measures<T> measures_of(const Corners<T>& corners)
{
  std::array<Point<T>, 4> normals;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& [a, b, c] = mesh::kTetFaceCorners[f];
    normals[f] = cross_of(difference(corners[b], corners[a]), difference(corners[c], corners[a]));
  }
  const T zero{};
  Measures<T> found{
      .volume = dot_of(normals[3], difference(corners[0], corners[3])) / 6.0,  // As tet_volume().
      .squared_lengths = sum_of_squared_lengths(corners),
      .largest_cosine = zero - 1.0,
      .smallest_cosine = zero + 1.0,
      .has_areas = zero == zero};
  for (Point<T>& normal : normals) {
    const T length = root(dot_of(normal, normal));
    found.has_areas &= length > zero;
    const T scale = 1.0 / length;
    normal = {scale * normal[0], scale * normal[1], scale * normal[2]};
  }
  for (const auto& [f, g] : mesh::kTetEdgeCorners) {
    const T cosine = -dot_of(normals[f], normals[g]);
    found.largest_cosine = found.largest_cosine < cosine ? cosine : found.largest_cosine;
    found.smallest_cosine = cosine < found.smallest_cosine ? cosine : found.smallest_cosine;
  }
  return found;
}

Measures<double> lane_of(const Measures<Lanes>& both, std::size_t lane)
{
  return {both.volume[lane], both.squared_lengths[lane], both.largest_cosine[lane],
          both.smallest_cosine[lane], both.has_areas[lane] != 0};
}

TetShape shape_from(const Measures<double>& measures)
{
  const double mean_ratio = mean_ratio_of(measures.volume, measures.squared_lengths);
  if (!measures.has_areas) return {mean_ratio, 1.0, -1.0};
  return {mean_ratio, measures.largest_cosine, measures.smallest_cosine};
}

Corners<Lanes> corners_of(std::span<const double> xyz, const LocalIndex* first,
                          const LocalIndex* second)
{
  Corners<Lanes> corners;
  for (std::size_t c = 0; c < 4; ++c) {
    const double* a = &xyz[3 * at(first[c])];
    const double* b = &xyz[3 * at(second[c])];
    for (std::size_t d = 0; d < 3; ++d) corners[c][d] = Lanes{a[d], b[d]};
  }
  return corners;
}

// From a cosine to the degrees below its angle: a guess from equal steps of the cosine, and from
// there on degree by degree.
class AngleTable {
 public:
  AngleTable()
  {
    for (std::size_t d = 0; d < cosines_.size(); ++d) {
      cosines_[d] = std::cos(static_cast<double>(d) * std::numbers::pi / 180.0);
    }
    std::size_t degrees = 0;
    for (std::size_t step = 0; step < kSteps; ++step) {
      const double largest = 1.0 - 2.0 * static_cast<double>(step) / kSteps;
      while (degrees < kLast && largest <= cosines_[degrees + 1]) ++degrees;
      guesses_[step] = degrees;
    }
  }

  [[nodiscard]] std::size_t whole_degrees(double cosine) const
  {
    if (!(cosine < 1.0)) return 0;
    if (cosine <= -1.0) return kLast;
    const auto step = static_cast<std::size_t>((1.0 - cosine) * (0.5 * kSteps));
    std::size_t degrees = guesses_[std::min(step, kSteps - 1)];
    while (degrees < kLast && cosine <= cosines_[degrees + 1]) ++degrees;
    return degrees;
  }

 private:
  static constexpr std::size_t kLast = 179;
  static constexpr std::size_t kSteps = 1024;

  std::array<double, kLast + 2> cosines_{};
  std::array<std::size_t, kSteps> guesses_{};
};

}  // namespace

double mean_ratio(const TetCorners& corners) noexcept
{
  return mean_ratio_of(tet_volume(corners[0], corners[1], corners[2], corners[3]),
                       sum_of_squared_lengths<double>(corners));
}

TetShape shape_of(const TetCorners& corners) noexcept
{
  return shape_from(measures_of<double>(corners));
}

void shapes_of(std::span<const double> xyz, std::span<const LocalIndex> tet_vertices,
               std::span<TetShape> shapes) noexcept
{
  for (std::size_t t = 0; t < shapes.size(); t += kNumLanes) {
    const std::size_t next = std::min(t + 1, shapes.size() - 1);  // The last may be alone.
    const Measures<Lanes> both =
        measures_of(corners_of(xyz, &tet_vertices[4 * t], &tet_vertices[4 * next]));
    shapes[t] = shape_from(lane_of(both, 0));
    shapes[next] = shape_from(lane_of(both, 1));
  }
}

double angle_deg(double cosine) noexcept
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

std::size_t whole_degrees(double cosine) noexcept
{
  static const AngleTable kTable;
  return kTable.whole_degrees(cosine);
}

}  // namespace tessera::quality
