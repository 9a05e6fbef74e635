// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::quality {

/// @brief Wanted worst values; table `[quality]` of a case file. Missed: the run ends degraded.
struct QualityTargets {
  double min_dihedral_deg = 0.0;  ///< Degrees, in [0, 70.5]; 0: none asked.
  double min_mean_ratio = 0.0;    ///< In [0, 1]; 0: none asked.

  friend bool operator==(const QualityTargets&, const QualityTargets&) = default;
};

}  // namespace tessera::quality
