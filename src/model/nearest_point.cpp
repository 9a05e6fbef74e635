// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tessera::model {
namespace {

constexpr LocalIndex kLeafSize = 4;
constexpr std::size_t kDeepest = 64;  // halving 2^31 parts gives 31 levels

template <class Part>
double middle_along(const Part& part, std::size_t axis)
{
  double sum = 0.0;
  for (const Vec3& corner : part) sum += corner[axis];
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

template <class Part>
NearestPointSearch<Part>::NearestPointSearch(std::span<const Part> parts) : numbers_(parts.size())
{
  double largest = 0.0;
  for (const Part& part : parts) {
    for (const Vec3& corner : part) {
      for (const double x : corner) largest = std::max(largest, std::abs(x));
    }
  }
  // Rounding of a nearest point must not put it outside its box, or a tie could be missed.
  padding_ = 64.0 * std::numeric_limits<double>::epsilon() * largest;
  std::iota(numbers_.begin(), numbers_.end(), 0);
  build(parts, 0, static_cast<LocalIndex>(parts.size()));
  for (const LocalIndex number : numbers_) parts_.push_back(parts[at(number)]);
}

template <class Part>
typename NearestPointSearch<Part>::Box NearestPointSearch<Part>::padded_box(
    std::span<const Part> parts, LocalIndex first, LocalIndex last) const
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (LocalIndex i = first; i < last; ++i) {
    for (const Vec3& corner : parts[at(numbers_[at(i)])]) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], corner[axis] - padding_);
        box.high[axis] = std::max(box.high[axis], corner[axis] + padding_);
      }
    }
  }
  return box;
}

template <class Part>
LocalIndex NearestPointSearch<Part>::build(std::span<const Part> parts, LocalIndex first,
                                           LocalIndex last)
{
  const auto node = static_cast<LocalIndex>(nodes_.size());
  const Box box = padded_box(parts, first, last);
  nodes_.push_back({box, kNoIndex, first, last - first});
  if (last - first <= kLeafSize) return node;

  const Vec3 extent = box.high - box.low;
  const auto axis = static_cast<std::size_t>(
      std::distance(extent.begin(), std::max_element(extent.begin(), extent.end())));
  const LocalIndex middle = first + (last - first) / 2;
  std::nth_element(numbers_.begin() + first, numbers_.begin() + middle, numbers_.begin() + last,
                   [&](LocalIndex a, LocalIndex b) {
                     return std::pair(middle_along(parts[at(a)], axis), a)
                            < std::pair(middle_along(parts[at(b)], axis), b);
                   });
  build(parts, first, middle);
  const LocalIndex other_child = build(parts, middle, last);
  nodes_[at(node)].other_child = other_child;
  return node;
}

template <class Part>
double NearestPointSearch<Part>::squared_distance(const Box& box, const Vec3& point) noexcept
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double outside =
        std::max({box.low[axis] - point[axis], point[axis] - box.high[axis], 0.0});
    sum += outside * outside;
  }
  return sum;
}

template <class Part>
void NearestPointSearch<Part>::look_into_leaf(const Node& leaf, const Vec3& point,
                                              NearestPoint& best) const
{
  for (LocalIndex i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const Vec3 candidate = nearest_point_of(parts_[at(i)], point);
    const Vec3 offset = candidate - point;
    const std::pair distance_and_number(dot(offset, offset), numbers_[at(i)]);
    if (distance_and_number < std::pair(best.squared_distance, best.part)) {
      best = {candidate, distance_and_number.second, distance_and_number.first};
    }
  }
}

// Quicker than the search by distance, as most boxes and tets are ruled out at once.
template <class Part>
LocalIndex NearestPointSearch<Part>::lowest_holding(const Vec3& point) const requires IsTet<Part>
{
  std::array<LocalIndex, kDeepest> to_visit;
  std::size_t num_to_visit = 0;
  LocalIndex lowest = kNoIndex;
  to_visit[num_to_visit++] = 0;
  while (num_to_visit > 0) {
    const LocalIndex number = to_visit[--num_to_visit];
    const Node& node = nodes_[at(number)];
    if (squared_distance(node.box, point) > 0.0) continue;
    if (node.other_child != kNoIndex) {
      to_visit[num_to_visit++] = node.other_child;
      to_visit[num_to_visit++] = number + 1;
      continue;
    }
    for (LocalIndex i = node.first; i < node.first + node.count; ++i) {
      const bool is_lower = lowest == kNoIndex || numbers_[at(i)] < lowest;
      if (is_lower && holds(parts_[at(i)], point)) lowest = numbers_[at(i)];
    }
  }
  return lowest;
}

template <class Part>
NearestPoint NearestPointSearch<Part>::nearest(const Vec3& point) const
{
  if constexpr (IsTet<Part>) {
    const LocalIndex holding = lowest_holding(point);
    if (holding != kNoIndex) return {point, holding, 0.0};
  }
  // Boxes at just the best distance are opened too: a tie with a lower number may be in there.
  struct Visit {
    LocalIndex node;
    double squared_distance;
  };
  std::array<Visit, kDeepest> to_visit;
  std::size_t num_to_visit = 0;
  NearestPoint best{{}, kNoIndex, std::numeric_limits<double>::infinity()};
  to_visit[num_to_visit++] = {0, 0.0};
  while (num_to_visit > 0) {
    const Visit visit = to_visit[--num_to_visit];
    if (visit.squared_distance > best.squared_distance) continue;
    const Node& node = nodes_[at(visit.node)];
    if (node.other_child == kNoIndex) {
      look_into_leaf(node, point, best);
      continue;
    }
    Visit near{visit.node + 1, squared_distance(nodes_[at(visit.node) + 1].box, point)};
    Visit far{node.other_child, squared_distance(nodes_[at(node.other_child)].box, point)};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    to_visit[num_to_visit++] = far;
    to_visit[num_to_visit++] = near;
  }
  return best;
}

template class NearestPointSearch<std::array<Vec3, 3>>;
template class NearestPointSearch<std::array<Vec3, 2>>;
template class NearestPointSearch<std::array<Vec3, 4>>;

}  // namespace tessera::model
