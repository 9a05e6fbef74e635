// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/insertion_order.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tessera/base/morton_order.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {
namespace {

// A round has 2^3 times as many points as all before it.
constexpr int kBitsARound = 3;
constexpr int kRounds = 7;

struct PlacedRow {
  Vec3 place{};
  LocalIndex row = 0;

  friend auto operator<=>(const PlacedRow&, const PlacedRow&) = default;
};

// By position; of equal ones only the lowest row.
std::vector<PlacedRow> different_points(std::span<const double> xyz)
{
  std::vector<PlacedRow> rows(xyz.size() / 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = {point_at(xyz, i), static_cast<LocalIndex>(i)};
  }
  std::ranges::sort(rows);
  const auto are_equal = [](const PlacedRow& a, const PlacedRow& b) { return a.place == b.place; };
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

std::vector<LocalIndex> along_curve(std::span<const double> xyz)
{
  const std::vector<PlacedRow> rows = different_points(xyz);
  std::vector<double> positions;
  positions.reserve(3 * rows.size());
  for (const auto& [place, row] : rows) {
    positions.insert(positions.end(), place.begin(), place.end());
  }
  std::vector<LocalIndex> order = morton_order(positions);
  for (LocalIndex& i : order) i = rows[at(i)].row;
  return order;
}

void sort_by_round(std::span<const Vec3> points, std::vector<LocalIndex>& rows)
{
  std::vector<std::uint8_t> round(points.size());
  for (const LocalIndex i : rows) round[at(i)] = static_cast<std::uint8_t>(round_of(points[at(i)]));
  std::ranges::stable_sort(rows, {}, [&](LocalIndex i) { return round[at(i)]; });
}

}  // namespace tessera::delaunay
