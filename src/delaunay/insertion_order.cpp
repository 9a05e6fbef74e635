// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/insertion_order.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include "tessera/base/morton_order.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {
namespace {

// A round has 2^3 times as many points as all before it.
constexpr int kBitsARound = 3;
constexpr int kRounds = 7;

// Rows by position, equal ones by row; of those only the first.
std::vector<LocalIndex> different_points(std::span<const double> xyz)
{
  std::vector<LocalIndex> rows(xyz.size() / 3);
  std::iota(rows.begin(), rows.end(), 0);
  const auto position = [xyz](LocalIndex row) { return point_at(xyz, row); };
  std::ranges::stable_sort(rows, {}, position);
  const auto are_equal = [&](LocalIndex a, LocalIndex b) { return position(a) == position(b); };
  rows.erase(std::unique(rows.begin(), rows.end(), are_equal), rows.end());
  return rows;
}

// Bits that look random, from the mantissas of a position: the same ones in another unit of length,
// if that is a power of two away.
std::uint64_t scattered_bits(const Vec3& p)
{
  constexpr int kBitsOfSignAndExponent = 12;
  std::uint64_t bits = 0;
  for (const double x : p) {
    bits = (bits ^ std::bit_cast<std::uint64_t>(x) << kBitsOfSignAndExponent) * 0x9e3779b97f4a7c15U;
    bits ^= bits >> 32;
  }
  bits *= 0xd6e8feb86659fd93U;
  return bits ^ (bits >> 32);
}

// From 0, of the fewest points.
int round_of(const Vec3& p)
{
  const int num_zeros = std::countr_zero(scattered_bits(p));
  return kRounds - 1 - std::min(num_zeros / kBitsARound, kRounds - 1);
}

}  // namespace

std::vector<LocalIndex> insertion_order(std::span<const double> xyz)
{
  const std::vector<LocalIndex> rows = different_points(xyz);
  std::vector<double> positions;
  positions.reserve(3 * rows.size());
  for (const LocalIndex row : rows) {
    const Vec3 p = point_at(xyz, row);
    positions.insert(positions.end(), p.begin(), p.end());
  }
  std::vector<LocalIndex> order = morton_order(positions);
  std::vector<std::uint8_t> round(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    round[i] = static_cast<std::uint8_t>(round_of(point_at(std::span<const double>(positions), i)));
  }
  std::ranges::stable_sort(order, {}, [&](LocalIndex i) { return round[at(i)]; });
  for (LocalIndex& i : order) i = rows[at(i)];
  return order;
}

}  // namespace tessera::delaunay
