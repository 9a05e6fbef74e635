// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/space_curve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera::optimize {
namespace {

constexpr int kBitsAnAxis = 10;
constexpr std::uint64_t kLastCell = (1U << kBitsAnAxis) - 1;

// Puts two zeros between the bits of a number below 2^10.
std::uint64_t spread_bits(std::uint64_t x)
{
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  x = (x | (x << 2)) & 0x09249249;
  return x;
}

struct Box {
  std::array<double, 3> low{};
  double cells_a_unit = 0.0;

  [[nodiscard]] std::uint64_t code(const Point& p) const
  {
    return spread_bits(cell(p.x, 0)) | (spread_bits(cell(p.y, 1)) << 1)
           | (spread_bits(cell(p.z, 2)) << 2);
  }

 private:
  [[nodiscard]] std::uint64_t cell(double value, std::size_t axis) const
  {
    const double place = (value - low[axis]) * cells_a_unit;
    return place > 0.0 ? std::min(static_cast<std::uint64_t>(place), kLastCell) : 0;
  }
};

// @pre points are finite, and so are their differences.
Box box_around(const std::vector<Point>& points)
{
  std::array<double, 3> low{points[0].x, points[0].y, points[0].z};
  std::array<double, 3> high = low;
  for (const Point& p : points) {
    const std::array<double, 3> xyz{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], xyz[axis]);
      high[axis] = std::max(high[axis], xyz[axis]);
    }
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  return {low, size > 0.0 ? static_cast<double>(kLastCell) / size : 0.0};
}

// Sorts by the high half, ten bits a pass; equal ones stay in order.
void radix_sort(std::vector<std::uint64_t>& keys)
{
  std::vector<std::uint64_t> sorted(keys.size());
  for (int shift = 32; shift < 32 + 3 * kBitsAnAxis; shift += kBitsAnAxis) {
    std::array<std::size_t, kLastCell + 2> offsets{};
    for (const std::uint64_t key : keys) ++offsets[((key >> shift) & kLastCell) + 1];
    for (std::size_t i = 0; i <= kLastCell; ++i) offsets[i + 1] += offsets[i];
    for (const std::uint64_t key : keys) sorted[offsets[(key >> shift) & kLastCell]++] = key;
    keys.swap(sorted);
  }
}

}  // namespace

std::vector<LocalIndex> morton_order(const std::vector<Point>& points)
{
  if (points.empty()) return {};
  const Box box = box_around(points);
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = (box.code(points[i]) << 32) | i;
  radix_sort(keys);
  std::vector<LocalIndex> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](std::uint64_t key) {
    return static_cast<LocalIndex>(static_cast<std::uint32_t>(key));
  });
  return order;
}

std::vector<LocalIndex> order_by_lowest_vertex(const std::vector<LocalIndex>& tet_vertices,
                                               LocalIndex num_vertices)
{
  const std::size_t num_tets = tet_vertices.size() / 4;
  const auto lowest = [&](std::size_t t) {
    const LocalIndex* v = &tet_vertices[4 * t];
    return at(std::min({v[0], v[1], v[2], v[3]}));
  };
  std::vector<LocalIndex> next(at(num_vertices) + 1, 0);
  for (std::size_t t = 0; t < num_tets; ++t) ++next[lowest(t) + 1];
  for (std::size_t v = 0; v < at(num_vertices); ++v) next[v + 1] += next[v];
  std::vector<LocalIndex> order(num_tets);
  for (std::size_t t = 0; t < num_tets; ++t) {
    order[at(next[lowest(t)]++)] = static_cast<LocalIndex>(t);
  }
  return order;
}

}  // namespace tessera::optimize
