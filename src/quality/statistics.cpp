// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "tessera/base/error.hpp"

namespace tessera::quality {

void Histogram::add(const Histogram& other)
{
  for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] += other.counts_[b];
}

void Histogram::subtract(const Histogram& other)
{
  for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] -= other.counts_[b];
}

void Histogram::set_counts(std::vector<GlobalIndex> counts)
{
  if (counts.size() != counts_.size()) throw InputError("a histogram has other bins than expected");
  counts_ = std::move(counts);
}

Histogram::Image Histogram::image() const
{
  Image image;
  for (std::size_t b = 0; b < counts_.size(); ++b) {
    if (counts_[b] == 0) continue;
    image.bins.push_back(static_cast<std::uint32_t>(b));
    image.counts.push_back(counts_[b]);
  }
  return image;
}

void Histogram::set_image(const Image& image)
{
  if (image.bins.size() != image.counts.size()) throw InputError("a histogram is cut off");
  std::vector<GlobalIndex> counts(counts_.size());
  for (std::size_t i = 0; i < image.bins.size(); ++i) {
    if (image.bins[i] >= counts.size()) throw InputError("a histogram has more bins than expected");
    counts[image.bins[i]] = image.counts[i];
  }
  counts_ = std::move(counts);
}

GlobalIndex Histogram::total() const
{
  return std::accumulate(counts_.begin(), counts_.end(), GlobalIndex{0});
}

double Histogram::percentile(double share) const
{
  const GlobalIndex all = total();
  if (all == 0) return 0.0;
  const auto below = static_cast<GlobalIndex>(share * static_cast<double>(all - 1));
  GlobalIndex passed = 0;
  std::size_t bin = 0;
  while (passed + counts_[bin] <= below) passed += counts_[bin++];
  const double width = (high_ - low_) / static_cast<double>(counts_.size());
  return low_ + (static_cast<double>(bin) + 0.5) * width;
}

std::vector<GlobalIndex> Histogram::coarsened(std::size_t num_bins) const
{
  const std::size_t group = counts_.size() / num_bins;
  std::vector<GlobalIndex> coarse(num_bins);
  for (std::size_t b = 0; b < counts_.size(); ++b) coarse[b / group] += counts_[b];
  return coarse;
}

double ks_distance(const Histogram& part, const Histogram& whole)
{
  const auto num_part = static_cast<double>(part.total());
  const double num_others = static_cast<double>(whole.total()) - num_part;
  if (num_part == 0.0 || num_others == 0.0) return 0.0;
  GlobalIndex part_below = 0;
  GlobalIndex others_below = 0;
  double largest = 0.0;
  for (std::size_t b = 0; b < part.counts().size(); ++b) {
    part_below += part.counts()[b];
    others_below += whole.counts()[b] - part.counts()[b];
    largest = std::max(largest, std::abs(static_cast<double>(part_below) / num_part
                                         - static_cast<double>(others_below) / num_others));
  }
  return largest;
}

void TetStatistics::add(const TetStatistics& other)
{
  num_tets += other.num_tets;
  min_dihedral_deg = std::min(min_dihedral_deg, other.min_dihedral_deg);
  max_dihedral_deg = std::max(max_dihedral_deg, other.max_dihedral_deg);
  min_mean_ratio = std::min(min_mean_ratio, other.min_mean_ratio);
  sum_mean_ratio += other.sum_mean_ratio;
}

double TetStatistics::mean_mean_ratio() const
{
  return num_tets == 0 ? 0.0 : sum_mean_ratio / static_cast<double>(num_tets);
}

void QualityHistograms::add(const QualityHistograms& other)
{
  mean_ratio.add(other.mean_ratio);
  seam_mean_ratio.add(other.seam_mean_ratio);
  log2_edge_length.add(other.log2_edge_length);
  min_dihedral_deg.add(other.min_dihedral_deg);
  max_dihedral_deg.add(other.max_dihedral_deg);
}

TetStatistics ShapeSum::statistics() const
{
  if (num_tets_ == 0) return {};
  return {num_tets_, angle_deg(worst_.largest_cosine), angle_deg(worst_.smallest_cosine),
          worst_.mean_ratio, sum_mean_ratio_};
}

}  // namespace tessera::quality
