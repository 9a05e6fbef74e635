// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/find_partners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "tessera/comm/record_exchange.hpp"

namespace tessera::comm {
namespace {

constexpr double kTolerance = 1e-9;  // Of the largest coordinate.

// Points are told apart along a direction that no side of a model is likely to lie across. Those of
// one slab across it go to one rank.
constexpr Vec3 kDirection{0.5357, 0.6180, 0.5755};
constexpr double kSlab = 1e-3;  // Of the largest coordinate.

// Whatever is not finite has no partner, and may be anywhere.
double along(const Vec3& point)
{
  const double place = dot(kDirection, point);
  return std::isfinite(place) ? place : 0.0;
}

// A point on its way to where its slab is looked at.
struct SlabPoint {
  SidePoint point{};
  std::int64_t slab = 0;

  static auto fields(auto& self) { return std::tie(self.point, self.slab); }
};

double largest_coordinate(std::span<const SidePoint> points, const Communicator& comm)
{
  double largest = 0.0;
  for (const SidePoint& one : points) {
    for (const double x : one.place) {
      if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
    }
  }
  return comm.max(largest);
}

// All points in their order; then, once more, those at the border of two slabs, for the other one.
std::vector<SlabPoint> in_slabs(std::span<const SidePoint> points, double largest)
{
  const double width = largest > 0.0 ? kSlab * largest : 1.0;
  const auto slab_of = [&](double place) {
    return static_cast<std::int64_t>(std::floor(place / width));
  };
  std::vector<SlabPoint> placed;
  placed.reserve(points.size());
  for (const SidePoint& one : points) placed.push_back({one, slab_of(along(one.place))});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = along(points[i].place);
    for (const double beside : {place - kTolerance * largest, place + kTolerance * largest}) {
      if (slab_of(beside) != placed[i].slab) placed.push_back({points[i], slab_of(beside)});
    }
  }
  return placed;
}

// The best partner that a point has found.
class Search {
 public:
  Search(const SidePoint& asker, double tolerance) : asker_(asker), nearest_(tolerance) {}

  // Whether others may be as near along the direction.
  [[nodiscard]] bool reaches(const SidePoint& other, double tolerance) const
  {
    return other.group == asker_.group
           && std::abs(along(other.place) - along(asker_.place)) <= tolerance;
  }

  void look_at(const SidePoint& other)
  {
    if (other.is_image == asker_.is_image) return;
    const double distance = norm(other.place - asker_.place);
    const bool is_better = label_ == kNoPartner || distance < nearest_ || other.label < label_;
    if (!(distance <= nearest_) || !is_better) return;
    nearest_ = distance;
    label_ = other.label;
  }

  [[nodiscard]] GlobalIndex label() const { return label_; }

 private:
  const SidePoint& asker_;
  double nearest_;
  GlobalIndex label_ = kNoPartner;
};

std::vector<GlobalIndex> partners_in(std::span<const SlabPoint> points, double tolerance)
{
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t row) {
    return std::tuple(points[row].point.group, along(points[row].point.place), row);
  });
  std::vector<GlobalIndex> partners(points.size(), kNoPartner);
  for (std::size_t i = 0; i < order.size(); ++i) {
    Search search(points[order[i]].point, tolerance);
    const auto other = [&](std::size_t j) -> const SidePoint& { return points[order[j]].point; };
    for (std::size_t j = i + 1; j < order.size() && search.reaches(other(j), tolerance); ++j)
      search.look_at(other(j));
    for (std::size_t j = i; j-- > 0 && search.reaches(other(j), tolerance);)
      search.look_at(other(j));
    partners[order[i]] = search.label();
  }
  return partners;
}

}  // namespace

std::vector<GlobalIndex> find_partners(std::span<const SidePoint> points, const Communicator& comm)
{
  const double largest = largest_coordinate(points, comm);
  const std::vector<SlabPoint> sent = in_slabs(points, largest);
  const RecordExchange<SlabPoint> exchange(
      sent, [](const SlabPoint& one) { return static_cast<std::uint64_t>(one.slab); }, comm);
  const std::vector<GlobalIndex> found = partners_in(exchange.received(), kTolerance * largest);
  std::vector<GlobalIndex> partners = exchange.answer<GlobalIndex>(found, comm);
  partners.resize(points.size());  // Copies ask for nothing.
  return partners;
}

}  // namespace tessera::comm
