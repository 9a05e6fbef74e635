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
  insert,        ///< [i] New vertices take the place of bad tets and of those around them.
  tighten,       ///< [t] From here on no tet gets worse than the worst one of now.
  divide,  ///< [d] Tets with several outer triangles of one group are divided; the worst one of now
           ///< is the bound from here on.
};

/// @brief What an optimisation does, in order, and where. All bounds are mean ratios in [0, 1].
///
/// The bounds were chosen on shaft.geo with 166 k tets (L = 2), looking at five other models. Two
/// steps were tried without a gain. One puts a vertex on edges of tets whose four corners are
/// fixed: with 64 subdomains no minimum rose, but two smallest angles by 0.6 degrees. The other
/// swaps bad tets for the sum of eta^-6. Step::insert is for coarse meshes and for
/// what NETGEN has filled: tets may have four corners on the boundary at a thin wall.
struct Schedule {
  std::vector<Step> steps{};

  /// Swaps begin at tets below this: good tets have little to gain.
  double swap_below = 0.85;
  /// Around tets below this every edge, rings of up to seven tets and faces are tried; elsewhere
  /// long edges with rings of three and four.
  double try_all_below = 0.6;
  /// A vertex may be collapsed if one of its tets is below this.
  double collapse_below = 0.7;
  /// A vertex is collapsed along edges shorter than this share of its mean edge, > 0.
  double collapse_reach = 0.85;
  /// How much the mean of eta^-1.5 around a vertex may rise by its collapse, >= 0. Smoothing
  /// repairs it. With 0.2 boxcyl.geo (L = 2) kept 3 % more tets than with 0.3.
  double collapse_loss = 0.3;
  /// Step::insert begins at tets below this.
  double insert_below = 0.3;
  /// Step::smooth_worst moves the vertices of tets below this.
  double worst_below = 0.7;
};

/// @brief Steps by their letters, e.g. "mmscmmww". @throws ConfigError naming an unknown letter.
[[nodiscard]] std::vector<Step> parse_steps(std::string_view letters);

// Figures: shaft.geo (166 k tets, L = 2); mean and 1st percentile of the mean ratio, smallest
// angle. Before 0.752, 0.471, 7.0 deg; after NETGEN's optimiser 0.869, 0.675, 19.6 deg.
[[nodiscard]] Schedule fast_schedule();      ///< 0.875, 0.697, 20.9 deg; fewest passes.
[[nodiscard]] Schedule standard_schedule();  ///< 0.879, 0.706, 21.0 deg.
[[nodiscard]] Schedule thorough_schedule();  ///< 0.883, 0.712, 22.6 deg; most passes.

}  // namespace tessera::optimize
