// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace tessera::optimize {

/// @brief One pass over the mesh. In brackets: its letter in a text of steps.
enum class Step : char {
  smooth,        ///< [m] Every free vertex goes towards the least sum of eta^-3 around it.
  smooth_worst,  ///< [w] The vertices of bad tets only, and the sum of eta^-12.
  swap,          ///< [s] Edges are removed, faces exchanged for edges.
  collapse,      ///< [c] Free vertices are merged into neighbours.
  tighten,       ///< [t] From here on no tet gets worse than the worst one of now.
};

/// @brief What an optimisation does, in order, and where. All bounds are mean ratios in [0, 1].
///
/// The bounds were chosen on shaft.geo with 166 k tets (L = 2), looking at five other models.
struct Schedule {
  std::vector<Step> steps{};

  /// Swaps begin at tets below this. Above it nearly no swap gains anything: 0.85 halves their time
  /// and costs 0.0005 of the mean.
  double swap_below = 0.85;
  /// Around tets below this every edge, rings of up to seven tets and faces are tried; elsewhere
  /// long edges with rings of three and four.
  double try_all_below = 0.6;
  /// A vertex may be collapsed if one of its tets is below this.
  double collapse_below = 0.7;
  /// A vertex is collapsed along edges shorter than this share of its mean edge, > 0.
  double collapse_reach = 0.85;
  /// How much the mean of eta^-1.5 around a vertex may rise by its collapse, >= 0. Smoothing
  /// repairs it; without a loss the 1st percentile stays 0.02 lower.
  double collapse_loss = 0.3;
  /// Step::smooth_worst moves the vertices of tets below this.
  double worst_below = 0.7;
};

/// @brief Steps by their letters, e.g. "mmscmmww". @throws ConfigError naming an unknown letter.
[[nodiscard]] std::vector<Step> parse_steps(std::string_view letters);

[[nodiscard]] Schedule fast_schedule();      ///< Fewest passes.
[[nodiscard]] Schedule standard_schedule();  ///< Swaps before every two passes of smoothing.
[[nodiscard]] Schedule thorough_schedule();  ///< Half as long again as the standard one.

}  // namespace tessera::optimize
