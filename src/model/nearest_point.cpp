// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tessera::model {
namespace {

template <class Simplex>
double middle_along(const Simplex& simplex, std::size_t axis)
{
  double sum = 0.0;
  for (const Vec3& corner : simplex) sum += corner[axis];
  return sum;
}

std::array<Vec3, 3> side_opposite(const std::array<Vec3, 4>& tet, std::size_t corner)
{
  return {tet[(corner + 1) % 4], tet[(corner + 2) % 4], tet[(corner + 3) % 4]};
}

bool is_on_inner_side(const std::array<Vec3, 4>& tet, std::size_t opposite, const Vec3& point)
{
  const auto [a, b, c] = side_opposite(tet, opposite);
  const Vec3 normal = cross(b - a, c - a);
  const double height = dot(normal, tet[opposite] - a);
  const double above = dot(normal, point - a);
  return height > 0.0 ? above >= 0.0 : height < 0.0 && above <= 0.0;
}

bool holds(const std::array<Vec3, 4>& tet, const Vec3& point)
{
  for (std::size_t opposite = 0; opposite < 4; ++opposite) {
    if (!is_on_inner_side(tet, opposite, point)) return false;
  }
  return true;
}

template <class Simplex>
SearchTree tree_of(std::span<const Simplex> simplices)
{
  double largest = 0.0;
  for (const Simplex& simplex : simplices) {
    for (const Vec3& corner : simplex) {
      for (const double x : corner) largest = std::max(largest, std::abs(x));
    }
  }
  // Rounding of a nearest point must not put it outside its box, or a tie could be missed.
  const double padding = 64.0 * std::numeric_limits<double>::epsilon() * largest;
  return SearchTree(
      static_cast<LocalIndex>(simplices.size()),
      [&](LocalIndex number) { return box_of(simplices[at(number)]).widened(padding); },
      [&](LocalIndex number, std::size_t axis) {
        return std::pair(middle_along(simplices[at(number)], axis), number);
      });
}

}  // namespace

Vec3 nearest_point_of(const std::array<Vec3, 2>& segment, const Vec3& point) noexcept
{
  const auto& [a, b] = segment;
  const Vec3 ab = b - a;
  const double along = dot(point - a, ab);
  const double length2 = dot(ab, ab);
  if (along <= 0.0) return a;
  if (along >= length2) return b;
  return a + (along / length2) * ab;
}

Vec3 nearest_point_of(const std::array<Vec3, 3>& triangle, const Vec3& point) noexcept
{
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double ab_a = dot(ab, point - a);
  const double ac_a = dot(ac, point - a);
  if (ab_a <= 0.0 && ac_a <= 0.0) return a;
  const double ab_b = dot(ab, point - b);
  const double ac_b = dot(ac, point - b);
  if (ab_b >= 0.0 && ac_b <= ab_b) return b;
  const double ab_c = dot(ab, point - c);
  const double ac_c = dot(ac, point - c);
  if (ac_c >= 0.0 && ab_c <= ac_c) return c;

  // Barycentric weights of the projection onto the plane, up to a common factor.
  const double weight_c = ab_a * ac_b - ab_b * ac_a;
  const double weight_b = ab_c * ac_a - ab_a * ac_c;
  const double weight_a = ab_b * ac_c - ab_c * ac_b;
  if (weight_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0)
    return nearest_point_of(std::array{a, b}, point);
  if (weight_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0)
    return nearest_point_of(std::array{a, c}, point);
  if (weight_a <= 0.0 && ac_b >= ab_b && ab_c >= ac_c)
    return nearest_point_of(std::array{b, c}, point);
  const double sum = weight_a + weight_b + weight_c;
  return a + (weight_b / sum) * ab + (weight_c / sum) * ac;
}

Vec3 nearest_point_of(const std::array<Vec3, 4>& tet, const Vec3& point) noexcept
{
  // The nearest point of a convex body lies on a side that the point sees from outside.
  Vec3 nearest = point;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t opposite = 0; opposite < 4; ++opposite) {
    if (is_on_inner_side(tet, opposite, point)) continue;
    const std::array<Vec3, 3> side = side_opposite(tet, opposite);
    const Vec3 candidate = nearest_point_of(side, point);
    const Vec3 offset = candidate - point;
    const double squared_distance = dot(offset, offset);
    if (squared_distance < least) {
      least = squared_distance;
      nearest = candidate;
    }
  }
  return nearest;
}

template <class Simplex>
NearestPointSearch<Simplex>::NearestPointSearch(std::span<const Simplex> simplices)
    : tree_(tree_of(simplices))
{
  for (const LocalIndex number : tree_.order()) simplices_.push_back(simplices[at(number)]);
}

// Quicker than the search by distance, as most boxes and tets are ruled out at once. Clang 14
// instantiates it for other simplices too, in spite of what it requires.
template <class Simplex>
LocalIndex NearestPointSearch<Simplex>::lowest_holding(
    const Vec3& point) const requires IsTet<Simplex>
{
  LocalIndex lowest = kNoIndex;
  tree_.search([&](LocalIndex node) { return tree_.nodes()[at(node)].box.squared_distance(point); },
               [](double squared_distance) { return !(squared_distance > 0.0); },
               [&](LocalIndex row) {
                 const LocalIndex number = tree_.order()[at(row)];
                 const bool is_lower = lowest == kNoIndex || number < lowest;
                 if constexpr (IsTet<Simplex>) {
                   if (is_lower && holds(simplices_[at(row)], point)) lowest = number;
                 }
               });
  return lowest;
}

template <class Simplex>
NearestPoint NearestPointSearch<Simplex>::nearest(const Vec3& point) const
{
  if constexpr (IsTet<Simplex>) {
    const LocalIndex holding = lowest_holding(point);
    if (holding != kNoIndex) return {point, holding, 0.0};
  }
  NearestPoint best{{}, kNoIndex, std::numeric_limits<double>::infinity()};
  tree_.search([&](LocalIndex node) { return tree_.nodes()[at(node)].box.squared_distance(point); },
               // At just the best distance there may be a simplex with a lower number.
               [&](double squared_distance) { return !(squared_distance > best.squared_distance); },
               [&](LocalIndex row) {
                 const Vec3 candidate = nearest_point_of(simplices_[at(row)], point);
                 const Vec3 offset = candidate - point;
                 const std::pair distance_and_number(dot(offset, offset), tree_.order()[at(row)]);
                 if (distance_and_number < std::pair(best.squared_distance, best.simplex)) {
                   best = {candidate, distance_and_number.second, distance_and_number.first};
                 }
               });
  return best;
}

template class NearestPointSearch<std::array<Vec3, 3>>;
template class NearestPointSearch<std::array<Vec3, 2>>;
template class NearestPointSearch<std::array<Vec3, 4>>;

}  // namespace tessera::model
