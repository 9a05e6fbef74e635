// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/size_function.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "tessera/model/nearest_point.hpp"

namespace tessera::surface {
namespace {

// NETGEN lets sizes grow faster than `grading` says: on a box with two rounded edges its triangles
// are as few as with this factor.
constexpr double kGrowthOfGrading = 1.7;

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
  build();
}

void SizeFunction::build()
{
  tree_ = SearchTree(
      static_cast<LocalIndex>(sources_.size()),
      [this](LocalIndex i) { return box_of(sources_[at(i)].corners); },
      [this](LocalIndex i, std::size_t axis) { return place_along(sources_[at(i)], axis); });
  std::vector<SizeSource> ordered;
  ordered.reserve(sources_.size());
  for (const LocalIndex i : tree_.order()) ordered.push_back(sources_[at(i)]);
  sources_ = std::move(ordered);
  least_.clear();
  for (const SearchTree::Node& node : tree_.nodes()) {
    const auto own = std::span(sources_).subspan(at(node.first), at(node.last - node.first));
    least_.push_back(std::ranges::min(own, {}, &SizeSource::size).size);
  }
}

double SizeFunction::size_beside(const SizeSource& source, const Vec3& place) const
{
  return source.size + growth_ * norm(model::nearest_point_of(source.corners, place) - place);
}

double SizeFunction::operator()(const Vec3& place) const
{
  double size = largest_;
  tree_.search(
      [&](LocalIndex node) {
        const Box& box = tree_.nodes()[at(node)].box;
        return least_[at(node)] + growth_ * std::sqrt(box.squared_distance(place));
      },
      [&](double least) { return least < size; },
      [&](LocalIndex row) {
        const SizeSource& source = sources_[at(row)];
        if (source.size >= size) return;
        size = std::min(size, size_beside(source, place));
      });
  return size;
}

bool SizeFunction::is_below(double limit, std::span<const Vec3> places) const
{
  if (largest_ < limit) return true;
  const Box around = bounding_box(places);
  bool is_found = false;
  tree_.search(
      [&](LocalIndex node) {
        const Box& box = tree_.nodes()[at(node)].box;
        return least_[at(node)] + growth_ * std::sqrt(box.squared_gap(around));
      },
      [&](double least) { return !is_found && least < limit; },
      [&](LocalIndex row) {
        const SizeSource& source = sources_[at(row)];
        if (source.size >= limit) return;
        const auto is_short = [&](const Vec3& place) { return size_beside(source, place) < limit; };
        is_found = is_found || std::ranges::any_of(places, is_short);
      });
  return is_found;
}

}  // namespace tessera::surface
