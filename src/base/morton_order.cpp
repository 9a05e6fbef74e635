// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/morton_order.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "tessera/base/box.hpp"

namespace tessera {
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

struct Grid {
  Vec3 low{};
  double cells_a_unit = 0.0;

  [[nodiscard]] std::uint64_t code(const Vec3& xyz) const
  {
    return spread_bits(cell(xyz, 0)) | (spread_bits(cell(xyz, 1)) << 1)
           | (spread_bits(cell(xyz, 2)) << 2);
  }

 private:
  [[nodiscard]] std::uint64_t cell(const Vec3& xyz, std::size_t axis) const
  {
    const double place = (xyz[axis] - low[axis]) * cells_a_unit;
    return place > 0.0 ? std::min(static_cast<std::uint64_t>(place), kLastCell) : 0;
  }
};

// The first three numbers of each row.
class Rows {
 public:
  Rows(std::span<const double> values, std::size_t width) : values_(values), width_(width) {}

  [[nodiscard]] std::size_t size() const { return values_.size() / width_; }
  [[nodiscard]] Vec3 operator[](std::size_t row) const
  {
    const double* at = &values_[width_ * row];
    return {at[0], at[1], at[2]};
  }

 private:
  std::span<const double> values_;
  std::size_t width_;
};

// @pre points are finite, and so are their differences.
Grid grid_around(const Rows& points)
{
  Box box;
  for (std::size_t row = 0; row < points.size(); ++row) box.include(points[row]);
  const double size = std::ranges::max(box.extent());
  return {box.low, size > 0.0 ? static_cast<double>(kLastCell) / size : 0.0};
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

std::vector<LocalIndex> morton_order(std::span<const double> values, std::size_t width)
{
  const Rows points(values, width);
  if (points.size() == 0) return {};
  const Grid grid = grid_around(points);
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = (grid.code(points[i]) << 32) | i;
  radix_sort(keys);
  std::vector<LocalIndex> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](std::uint64_t key) {
    return static_cast<LocalIndex>(static_cast<std::uint32_t>(key));
  });
  return order;
}

}  // namespace tessera
