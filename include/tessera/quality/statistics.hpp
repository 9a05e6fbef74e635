// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::quality {

/// @brief Counts of values in equal bins; percentiles of it are the same for any number of ranks.
class Histogram {
 public:
  /// @brief `num_bins` equal bins over [low, high]; values outside fall in the first or last.
  Histogram(double low, double high, std::size_t num_bins)
      : low_(low), high_(high), counts_(num_bins)
  {
  }

  void add(double value);
  void add(const Histogram& other);  ///< @pre the same bins.

  [[nodiscard]] GlobalIndex total() const;

  /// @brief Middle of the bin that holds the value with `share` (in [0, 1]) of all below it; 0 if
  /// empty.
  [[nodiscard]] double percentile(double share) const;

  /// @brief The counts gathered into `num_bins` equal bins. @pre num_bins divides the bins.
  [[nodiscard]] std::vector<GlobalIndex> coarsened(std::size_t num_bins) const;

  void write(ByteWriter& out) const { out.put(counts_); }
  void read(ByteReader& in) { counts_ = in.get_vector<GlobalIndex>(); }

 private:
  double low_;
  double high_;
  std::vector<GlobalIndex> counts_;
};

/// @brief Shape statistics of some tets, made to be merged: minima and counts are exact, sums are
/// added in the order of the merges.
struct TetStatistics {
  GlobalIndex num_tets = 0;
  double min_dihedral_deg = 180.0;
  double max_dihedral_deg = 0.0;
  double min_mean_ratio = 1.0;
  double sum_mean_ratio = 0.0;
  Histogram mean_ratio{0.0, 1.0, 2000};  ///< Bins of 0.0005.

  void add(const TetCorners& corners);
  void add(const TetStatistics& other);
  [[nodiscard]] double mean_mean_ratio() const;
};

/// @brief Statistics of the edge lengths: bins of log2(length), 64 an octave (1.1 % wide), from 2^-40
/// to 2^40 output length units.
struct EdgeStatistics {
  Histogram log2_length{-40.0, 40.0, 80 * 64};

  void add(double length);
  void add(const EdgeStatistics& other) { log2_length.add(other.log2_length); }
  [[nodiscard]] double percentile(double share) const;  ///< Output length unit.
};

void write(ByteWriter& out, const TetStatistics& statistics);
[[nodiscard]] TetStatistics read_tet_statistics(ByteReader& in);
void write(ByteWriter& out, const EdgeStatistics& statistics);
[[nodiscard]] EdgeStatistics read_edge_statistics(ByteReader& in);

}  // namespace tessera::quality
