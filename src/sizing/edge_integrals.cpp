// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "tessera/sizing/size_field.hpp"

namespace tessera::sizing {
namespace {

constexpr int kMostHalvings = 12;
constexpr double kLargestChange = 0.3;         // Of the size along an interval, in parts of it.
constexpr std::size_t kBlockSize = 1U << 14U;  // Edges at a time, so that memory is bounded.

struct Edge {
  Vec3 begin{};
  Vec3 along{};
  double length = 0.0;

  [[nodiscard]] Vec3 at(double fraction) const { return begin + fraction * along; }
};

// A part of an edge, in fractions of it, and the sizes at its ends.
struct Interval {
  std::uint32_t edge = 0;
  double begin = 0.0;
  double end = 1.0;
  double size_at_begin = 0.0;
  double size_at_end = 0.0;

  [[nodiscard]] double middle() const { return 0.5 * (begin + end); }
};

// Simpson's rule for a size that is linear in between.
double integral_over(const Interval& part, double length)
{
  const double a = part.size_at_begin;
  const double b = part.size_at_end;
  return length / 6.0 * (1.0 / a + 8.0 / (a + b) + 1.0 / b);
}

class BlockOfEdges {
 public:
  BlockOfEdges(const SizeField& sizes, std::span<double> integrals)
      : sizes_(sizes), integrals_(integrals)
  {
    if (sizes.steepest() > 0.0) longest_ = std::min(1.0, kLargestChange / sizes.steepest());
  }

  void add(const Edge& edge, double size_at_begin, double size_at_end)
  {
    open_.push_back(
        {static_cast<std::uint32_t>(edges_.size()), 0.0, 1.0, size_at_begin, size_at_end});
    edges_.push_back(edge);
  }

  void integrate()
  {
    for (int halvings = 0; !open_.empty(); ++halvings) {
      keep_open([&](const Interval& part) {
        const double length = (part.end - part.begin) * edges_[part.edge].length;
        const double size = std::min(part.size_at_begin, part.size_at_end);
        if (halvings < kMostHalvings && length > longest_ * size) return true;
        integrals_[part.edge] += integral_over(part, length);
        return false;
      });
      halve();
    }
  }

 private:
  template <class StaysOpen>
  void keep_open(const StaysOpen& stays_open)
  {
    std::erase_if(open_, [&](const Interval& part) { return !stays_open(part); });
  }

  void halve()
  {
    std::vector<double> middles;
    middles.reserve(3 * open_.size());
    for (const Interval& part : open_) {
      const Vec3 middle = edges_[part.edge].at(part.middle());
      middles.insert(middles.end(), middle.begin(), middle.end());
    }
    const std::vector<double> sizes = sizes_.at(middles);
    std::vector<Interval> halves;
    halves.reserve(2 * open_.size());
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const Interval& part = open_[i];
      halves.push_back({part.edge, part.begin, part.middle(), part.size_at_begin, sizes[i]});
      halves.push_back({part.edge, part.middle(), part.end, sizes[i], part.size_at_end});
    }
    open_ = std::move(halves);
  }

  const SizeField& sizes_;
  std::span<double> integrals_;
  double longest_ = std::numeric_limits<double>::infinity();  // Interval, in sizes at its ends.
  std::vector<Edge> edges_{};
  std::vector<Interval> open_{};
};

}  // namespace

std::vector<double> edge_size_integrals(const mesh::CoarseMesh& coarse,
                                        std::span<const LocalIndex> edge_vertices,
                                        const SizeField& sizes)
{
  const std::vector<double> at_vertices = sizes.at(coarse.vertex_xyz);
  std::vector<double> integrals(edge_vertices.size() / 2, 0.0);
  for (std::size_t first = 0; first < integrals.size(); first += kBlockSize) {
    const std::size_t last = std::min(first + kBlockSize, integrals.size());
    BlockOfEdges block(sizes, std::span(integrals).subspan(first, last - first));
    for (std::size_t edge = first; edge < last; ++edge) {
      const auto [a, b] = std::minmax(edge_vertices[2 * edge], edge_vertices[2 * edge + 1]);
      const Vec3 along = coarse.position(b) - coarse.position(a);
      block.add({coarse.position(a), along, norm(along)}, at_vertices[at(a)], at_vertices[at(b)]);
    }
    block.integrate();
  }
  return integrals;
}

}  // namespace tessera::sizing
