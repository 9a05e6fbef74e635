// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tessera::quality {

void Histogram::add(double value)
{
  const double scaled =
      (value - low_) / (high_ - low_) * static_cast<double>(counts_.size());
  const double last = static_cast<double>(counts_.size() - 1);
  ++counts_[static_cast<std::size_t>(std::clamp(std::floor(scaled), 0.0, last))];
}

void Histogram::add(const Histogram& other)
{
  for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] += other.counts_[b];
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

void TetStatistics::add(const TetCorners& corners)
{
  const double eta = quality::mean_ratio(corners);
  const DihedralRange dihedral = dihedral_range(corners);
  ++num_tets;
  min_dihedral_deg = std::min(min_dihedral_deg, dihedral.min_deg);
  max_dihedral_deg = std::max(max_dihedral_deg, dihedral.max_deg);
  min_mean_ratio = std::min(min_mean_ratio, eta);
  sum_mean_ratio += eta;
  mean_ratio.add(eta);
}

void TetStatistics::add(const TetStatistics& other)
{
  num_tets += other.num_tets;
  min_dihedral_deg = std::min(min_dihedral_deg, other.min_dihedral_deg);
  max_dihedral_deg = std::max(max_dihedral_deg, other.max_dihedral_deg);
  min_mean_ratio = std::min(min_mean_ratio, other.min_mean_ratio);
  sum_mean_ratio += other.sum_mean_ratio;
  mean_ratio.add(other.mean_ratio);
}

double TetStatistics::mean_mean_ratio() const
{
  return num_tets == 0 ? 0.0 : sum_mean_ratio / static_cast<double>(num_tets);
}

void EdgeStatistics::add(double length) { log2_length.add(std::log2(length)); }

double EdgeStatistics::percentile(double share) const
{
  return log2_length.total() == 0 ? 0.0 : std::exp2(log2_length.percentile(share));
}

void write(ByteWriter& out, const TetStatistics& statistics)
{
  out.put(statistics.num_tets);
  out.put(statistics.min_dihedral_deg);
  out.put(statistics.max_dihedral_deg);
  out.put(statistics.min_mean_ratio);
  out.put(statistics.sum_mean_ratio);
  statistics.mean_ratio.write(out);
}

TetStatistics read_tet_statistics(ByteReader& in)
{
  TetStatistics statistics;
  statistics.num_tets = in.get<GlobalIndex>();
  statistics.min_dihedral_deg = in.get<double>();
  statistics.max_dihedral_deg = in.get<double>();
  statistics.min_mean_ratio = in.get<double>();
  statistics.sum_mean_ratio = in.get<double>();
  statistics.mean_ratio.read(in);
  return statistics;
}

void write(ByteWriter& out, const EdgeStatistics& statistics) { statistics.log2_length.write(out); }

EdgeStatistics read_edge_statistics(ByteReader& in)
{
  EdgeStatistics statistics;
  statistics.log2_length.read(in);
  return statistics;
}

}  // namespace tessera::quality
