// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/check/report.hpp"

namespace tessera::check {

/// @brief Shape of one tet.
struct TetShape {
  double mean_ratio = 0.0;  ///< 0 if the volume is not positive.
  double min_dihedral_cosine = 0.0;
  double max_dihedral_cosine = 0.0;
};

/// @brief Mean ratio and extreme dihedral angles. Local. @pre the corners are finite.
[[nodiscard]] TetShape shape_of(const std::array<Vec3, 4>& corners);

/// @brief Floating-point figures of the tets of one piece, added in the order of its cells.
struct ShapeSums {
  GlobalIndex num_tets = 0;
  double mean_ratio_sum = 0.0;
  double mean_ratio_min = std::numeric_limits<double>::infinity();
  double min_cosine = std::numeric_limits<double>::infinity();  ///< Of dihedral angles.
  double max_cosine = -std::numeric_limits<double>::infinity();

  static auto fields(auto& self)
  {
    return std::tie(self.num_tets, self.mean_ratio_sum, self.mean_ratio_min, self.min_cosine,
                    self.max_cosine);
  }

  void add(const TetShape& shape);
  void add(const ShapeSums& piece);
};

/// @brief Counts of mean ratios in fine bins; sums of counts do not depend on the number of ranks.
class MeanRatioCounts {
 public:
  static constexpr std::size_t kNumBins = 2000;

  void add(double mean_ratio);
  [[nodiscard]] std::vector<GlobalIndex>& counts() { return counts_; }
  [[nodiscard]] const std::vector<GlobalIndex>& counts() const { return counts_; }

 private:
  std::vector<GlobalIndex> counts_ = std::vector<GlobalIndex>(kNumBins, 0);
};

/// @brief Largest difference between the shares below any mean ratio, of `part` and of the others
/// of `whole`: Kolmogorov and Smirnov's distance, to the width of a bin; 0 if either is empty.
/// Local.
[[nodiscard]] double ks_distance(const MeanRatioCounts& part, const MeanRatioCounts& whole);

/// @brief Counts of edge lengths in bins that split each octave into 128 equal parts.
class EdgeLengths {
 public:
  void add(double length);  ///< Lengths outside 2^-256…2^256 count in the outermost bins.
  [[nodiscard]] std::vector<GlobalIndex>& counts() { return counts_; }
  [[nodiscard]] EdgeLengthFigures figures() const;

 private:
  static constexpr int kBinsPerOctave = 128;
  static constexpr int kMaxExponent = 256;
  [[nodiscard]] double percentile(double share) const;

  std::vector<GlobalIndex> counts_ =
      std::vector<GlobalIndex>(std::size_t{2} * kMaxExponent * kBinsPerOctave, 0);
};

[[nodiscard]] QualityFigures quality_figures(const ShapeSums& sums, const MeanRatioCounts& counts);

}  // namespace tessera::check
