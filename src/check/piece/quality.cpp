// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/quality.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace tessera::check {
namespace {

// First bin at which the running count reaches `share` of all.
std::size_t bin_of_share(const std::vector<GlobalIndex>& counts, double share)
{
  const auto total = std::accumulate(counts.begin(), counts.end(), GlobalIndex{0});
  const auto wanted = std::max<GlobalIndex>(
      1, static_cast<GlobalIndex>(std::ceil(share * static_cast<double>(total))));
  GlobalIndex running = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    running += counts[bin];
    if (running >= wanted) return bin;
  }
  return counts.size();
}

double degrees_of_cosine(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace

TetShape shape_of(const std::array<Vec3, 4>& corners)
{
  const Vec3 a = corners[1] - corners[0];
  const Vec3 b = corners[2] - corners[0];
  const Vec3 c = corners[3] - corners[0];
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double volume = dot(cross(a, b), c) / 6.0;
  const double squared_lengths =
      dot(a, a) + dot(b, b) + dot(c, c) + dot(ab, ab) + dot(bc, bc) + dot(ca, ca);

  TetShape shape;
  if (volume > 0.0) shape.mean_ratio = 12.0 * std::cbrt(9.0 * volume * volume) / squared_lengths;

  // Unit inward normals of the four faces; the angle between faces is pi less that of the
  // normals.
  std::array<Vec3, 4> normals{cross(bc, ab), cross(b, c), cross(c, a), cross(a, b)};
  for (Vec3& normal : normals) {
    const double length = norm(normal);
    if (length > 0.0) normal = (1.0 / length) * normal;
  }
  shape.min_dihedral_cosine = 1.0;
  shape.max_dihedral_cosine = -1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -dot(normals[i], normals[j]);
      shape.min_dihedral_cosine = std::min(shape.min_dihedral_cosine, cosine);
      shape.max_dihedral_cosine = std::max(shape.max_dihedral_cosine, cosine);
    }
  }
  return shape;
}

void ShapeSums::add(const TetShape& shape)
{
  ++num_tets;
  mean_ratio_sum += shape.mean_ratio;
  mean_ratio_min = std::min(mean_ratio_min, shape.mean_ratio);
  min_cosine = std::min(min_cosine, shape.min_dihedral_cosine);
  max_cosine = std::max(max_cosine, shape.max_dihedral_cosine);
}

void ShapeSums::add(const ShapeSums& piece)
{
  num_tets += piece.num_tets;
  mean_ratio_sum += piece.mean_ratio_sum;
  mean_ratio_min = std::min(mean_ratio_min, piece.mean_ratio_min);
  min_cosine = std::min(min_cosine, piece.min_cosine);
  max_cosine = std::max(max_cosine, piece.max_cosine);
}

void MeanRatioCounts::add(double mean_ratio)
{
  const auto bin = static_cast<std::size_t>(mean_ratio * static_cast<double>(kNumBins));
  ++counts_[std::min(bin, kNumBins - 1)];
}

double ks_distance(const MeanRatioCounts& part, const MeanRatioCounts& whole)
{
  std::array<GlobalIndex, 2> total{};
  for (std::size_t bin = 0; bin < MeanRatioCounts::kNumBins; ++bin) {
    total[0] += part.counts()[bin];
    total[1] += whole.counts()[bin] - part.counts()[bin];
  }
  if (total[0] == 0 || total[1] == 0) return 0.0;
  std::array<GlobalIndex, 2> below{};
  double distance = 0.0;
  for (std::size_t bin = 0; bin < MeanRatioCounts::kNumBins; ++bin) {
    below[0] += part.counts()[bin];
    below[1] += whole.counts()[bin] - part.counts()[bin];
    const double share = static_cast<double>(below[0]) / static_cast<double>(total[0]);
    const double other = static_cast<double>(below[1]) / static_cast<double>(total[1]);
    distance = std::max(distance, std::abs(share - other));
  }
  return distance;
}

// Exponent and first seven bits of the fraction are the bin but for its origin.
void EdgeLengths::add(double length)
{
  static_assert(kBinsPerOctave == 1 << 7, "the shift fits these");
  constexpr std::int64_t kOriginBits = std::int64_t{1022 - kMaxExponent} * kBinsPerOctave;
  if (!std::isfinite(length) || length <= 0.0) return;
  const std::int64_t bin = (std::bit_cast<std::int64_t>(length) >> (52 - 7)) - kOriginBits;
  const auto last = static_cast<std::int64_t>(counts_.size()) - 1;
  ++counts_[static_cast<std::size_t>(std::clamp<std::int64_t>(bin, 0, last))];
}

double EdgeLengths::percentile(double share) const
{
  const std::size_t bin = bin_of_share(counts_, share);
  if (bin == counts_.size()) return 0.0;
  const int exponent = static_cast<int>(bin) / kBinsPerOctave - kMaxExponent;
  const int part = static_cast<int>(bin) % kBinsPerOctave;
  return std::ldexp(0.5 + (part + 0.5) / (2.0 * kBinsPerOctave), exponent);
}

EdgeLengthFigures EdgeLengths::figures() const
{
  return {percentile(0.01), percentile(0.5), percentile(0.99)};
}

QualityFigures quality_figures(const ShapeSums& sums, const MeanRatioCounts& counts)
{
  QualityFigures figures;
  figures.num_tets = sums.num_tets;
  if (sums.num_tets == 0) return figures;
  figures.min_dihedral_deg = degrees_of_cosine(sums.max_cosine);
  figures.max_dihedral_deg = degrees_of_cosine(sums.min_cosine);
  figures.mean_ratio_min = sums.mean_ratio_min;
  figures.mean_ratio_mean = sums.mean_ratio_sum / static_cast<double>(sums.num_tets);

  const std::vector<GlobalIndex>& fine = counts.counts();
  figures.mean_ratio_p01 = (static_cast<double>(bin_of_share(fine, 0.01)) + 0.5)
                           / static_cast<double>(MeanRatioCounts::kNumBins);
  constexpr std::size_t kBinsPerBar =
      MeanRatioCounts::kNumBins / std::tuple_size_v<decltype(figures.mean_ratio_histogram)>;
  for (std::size_t bin = 0; bin < fine.size(); ++bin)
    figures.mean_ratio_histogram[bin / kBinsPerBar] += fine[bin];
  return figures;
}

}  // namespace tessera::check
