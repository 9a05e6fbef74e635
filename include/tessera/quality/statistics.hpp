// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::quality {

/// @brief Counts of values in equal bins; percentiles of it are the same for any number of ranks.
class Histogram {
 public:
  /// @brief `num_bins` equal bins over [low, high]; values outside fall in the first or last.
  Histogram(double low, double high, std::size_t num_bins)
      : low_(low),
        high_(high),
        bins_a_unit_(static_cast<double>(num_bins) / (high - low)),
        counts_(num_bins)
  {
  }

  void add(double value)
  {
    const double place = (value - low_) * bins_a_unit_;
    const std::size_t last = counts_.size() - 1;
    if (!(place > 0.0)) {  // Written so that a NaN has a place.
      ++counts_.front();
    } else if (place >= static_cast<double>(last)) {
      ++counts_[last];
    } else {
      ++counts_[static_cast<std::size_t>(place)];
    }
  }
  /// @brief Counts one value of a bin. @pre bin < counts().size()
  void add_to_bin(std::size_t bin) { ++counts_[bin]; }
  void add(const Histogram& other);       ///< @pre the same bins.
  void subtract(const Histogram& other);  ///< @pre the same bins, and `other` was added before.

  [[nodiscard]] GlobalIndex total() const;

  /// @brief Middle of the bin that holds the value with `share` (in [0, 1]) of all below it; 0 if
  /// empty.
  [[nodiscard]] double percentile(double share) const;

  /// @brief The counts gathered into `num_bins` equal bins. @pre num_bins divides the bins.
  [[nodiscard]] std::vector<GlobalIndex> coarsened(std::size_t num_bins) const;

  [[nodiscard]] const std::vector<GlobalIndex>& counts() const { return counts_; }
  void set_counts(std::vector<GlobalIndex> counts);  ///< @throws InputError if the bins differ.

  /// @brief The bins that are not empty, as most of those of one piece are.
  struct Image {
    std::vector<std::uint32_t> bins{};  ///< Ascending.
    std::vector<GlobalIndex> counts{};  ///< Parallel to bins.

    static auto fields(auto& self) { return std::tie(self.bins, self.counts); }
  };
  [[nodiscard]] Image image() const;
  void set_image(const Image& image);  ///< @throws InputError if there is no such bin.

 private:
  double low_;
  double high_;
  double bins_a_unit_;
  std::vector<GlobalIndex> counts_;
};

/// @brief Kolmogorov-Smirnov distance between the values of `part` and the others of `whole`, in
/// [0, 1]. It is the largest difference of the shares below any value, to the width of a bin. 0 if
/// either is empty.
/// @pre the same bins; `part` counts nothing that `whole` does not.
[[nodiscard]] double ks_distance(const Histogram& part, const Histogram& whole);

/// @brief Shape statistics of some tets. Extremes and counts are exact; the sum is that of the
/// order in which tets and parts were added.
struct TetStatistics {
  GlobalIndex num_tets = 0;
  double min_dihedral_deg = 180.0;
  double max_dihedral_deg = 0.0;
  double min_mean_ratio = 1.0;
  double sum_mean_ratio = 0.0;

  static auto fields(auto& self)
  {
    return std::tie(self.num_tets, self.min_dihedral_deg, self.max_dihedral_deg,
                    self.min_mean_ratio, self.sum_mean_ratio);
  }

  void add(const TetStatistics& other);
  [[nodiscard]] double mean_mean_ratio() const;
};

/// @brief Distributions over tets and edges; merged in any order they are the same.
struct QualityHistograms {
  Histogram mean_ratio{0.0, 1.0, 2000};       ///< Of all tets; bins of 0.0005.
  Histogram seam_mean_ratio{0.0, 1.0, 2000};  ///< Of the seam tets.
  /// Of log2(edge length / output length unit): 64 bins an octave (1.1 % wide), from -40 to 40.
  Histogram log2_edge_length{-40.0, 40.0, std::size_t{80} * 64};
  Histogram min_dihedral_deg{0.0, 180.0, 180};  ///< The smallest angle of every tet.
  Histogram max_dihedral_deg{0.0, 180.0, 180};  ///< The largest one.

  static auto fields(auto& self)
  {
    return std::tie(self.mean_ratio, self.seam_mean_ratio, self.log2_edge_length,
                    self.min_dihedral_deg, self.max_dihedral_deg);
  }

  void add(const QualityHistograms& other);

  /// @brief Counts the extreme dihedral angles of a tet.
  void add_angles(const TetShape& shape)
  {
    min_dihedral_deg.add_to_bin(whole_degrees(shape.largest_cosine));
    max_dihedral_deg.add_to_bin(whole_degrees(shape.smallest_cosine));
  }
};

/// @brief Gathers the shapes of tets, one after the other, into statistics and a histogram.
class ShapeSum {
 public:
  /// @param[in,out] mean_ratios Borrowed.
  explicit ShapeSum(Histogram& mean_ratios) : mean_ratios_(mean_ratios) {}

  void add(const TetShape& shape)
  {
    ++num_tets_;
    sum_mean_ratio_ += shape.mean_ratio;
    worst_.mean_ratio = std::min(worst_.mean_ratio, shape.mean_ratio);
    worst_.largest_cosine = std::max(worst_.largest_cosine, shape.largest_cosine);
    worst_.smallest_cosine = std::min(worst_.smallest_cosine, shape.smallest_cosine);
    mean_ratios_.add(shape.mean_ratio);
  }

  [[nodiscard]] TetStatistics statistics() const;

 private:
  Histogram& mean_ratios_;
  GlobalIndex num_tets_ = 0;
  double sum_mean_ratio_ = 0.0;
  TetShape worst_{.mean_ratio = 1.0};
};

}  // namespace tessera::quality
