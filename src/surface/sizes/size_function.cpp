// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/size_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "tessera/model/nearest_point.hpp"

namespace tessera::surface {
namespace {

constexpr LocalIndex kLeafSize = 4;
constexpr std::size_t kDeepest = 64;  // Halving 2^31 sources gives 31 levels.

// NETGEN lets sizes grow faster than `grading` says: on a box with two rounded edges its triangles
// are as few as with this factor.
constexpr double kGrowthOfGrading = 1.7;

double distance(const Box& box, const Vec3& point)
{
  double sum = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double outside = std::max({box.low[d] - point[d], point[d] - box.high[d], 0.0});
    sum += outside * outside;
  }
  return std::sqrt(sum);
}

// Ties are broken by all that a source is, so that the order of the leaves is the same everywhere.
auto place_along(const SizeSource& source, std::size_t axis)
{
  const auto& [a, b, c] = source.corners;
  return std::tuple(a[axis] + b[axis] + c[axis], source.corners, source.size);
}

}  // namespace

SizeFunction::SizeFunction(const CoarseOptions& options)
    : largest_(options.max_size), growth_(kGrowthOfGrading * options.grading)
{
  std::vector<SizeSource> sources;
  for (std::size_t i = 0; i < options.points.size.size(); ++i) {
    const Vec3 place = point_at(std::span(options.points.xyz), i);
    sources.push_back({{place, place, place}, options.points.size[i]});
  }
  limit(sources);
}

void SizeFunction::limit(const std::vector<SizeSource>& sources)
{
  for (const SizeSource& source : sources) {
    if (source.size < largest_) sources_.push_back(source);
  }
  nodes_.clear();
  if (!sources_.empty()) build(0, static_cast<LocalIndex>(sources_.size()));
}

LocalIndex SizeFunction::build(LocalIndex first, LocalIndex last)
{
  const auto number = static_cast<LocalIndex>(nodes_.size());
  Node node{.least = std::numeric_limits<double>::infinity(), .first = first, .last = last};
  for (LocalIndex i = first; i < last; ++i) {
    node.box.include(box_of(sources_[at(i)].corners));
    node.least = std::min(node.least, sources_[at(i)].size);
  }
  nodes_.push_back(node);
  if (last - first <= kLeafSize) return number;
  const Vec3 extent = node.box.high - node.box.low;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  const LocalIndex middle = first + (last - first) / 2;
  std::ranges::nth_element(sources_.begin() + first, sources_.begin() + middle,
                           sources_.begin() + last, {},
                           [axis](const SizeSource& one) { return place_along(one, axis); });
  build(first, middle);
  const LocalIndex other_child = build(middle, last);
  nodes_[at(number)].other_child = other_child;
  return number;
}

double SizeFunction::least_in(const Node& node, const Vec3& place) const
{
  return node.least + growth_ * distance(node.box, place);
}

// The child that may have the lower size comes first: most of the others are ruled out by it.
double SizeFunction::operator()(const Vec3& place) const
{
  struct Visit {
    double least;
    LocalIndex node;
  };
  double size = largest_;
  std::array<Visit, kDeepest> to_visit;
  std::size_t num_to_visit = 0;
  if (!nodes_.empty()) to_visit[num_to_visit++] = {least_in(nodes_[0], place), 0};
  while (num_to_visit > 0) {
    const auto [least, number] = to_visit[--num_to_visit];
    if (least >= size) continue;
    const Node& node = nodes_[at(number)];
    if (node.other_child != kNoIndex) {
      Visit first{least_in(nodes_[at(number) + 1], place), number + 1};
      Visit second{least_in(nodes_[at(node.other_child)], place), node.other_child};
      if (second.least < first.least) std::swap(first, second);
      if (second.least < size) to_visit[num_to_visit++] = second;
      if (first.least < size) to_visit[num_to_visit++] = first;
      continue;
    }
    for (LocalIndex i = node.first; i < node.last; ++i) {
      const SizeSource& source = sources_[at(i)];
      if (source.size >= size) continue;
      const double apart = norm(model::nearest_point_of(source.corners, place) - place);
      size = std::min(size, source.size + growth_ * apart);
    }
  }
  return size;
}

}  // namespace tessera::surface
