// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::improve {

/// @brief Tets with vertices of their own.
struct TetMesh {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.
};

/// @brief What an optimiser gets. The vertices of the boundary triangles are fixed and come first.
struct OptimizeInput {
  const TetMesh& tets;
  LocalIndex num_fixed = 0;
  const std::vector<LocalIndex>& triangle_vertices;  ///< Shape (num_triangles, 3); outward.
};

/// @brief What an optimiser does.
///
/// Measured on seams of 64 subdomains (shaft, L = 2, 143 k tets; with one subdomain: mean of the
/// mean ratio 0.866, 1st percentile 0.662), all three phases:
///   as filled           0.806, 0.497, smallest angle 3.8 deg
///   cmdmustm, power 2   0.816, 0.531, 10.0 deg: d makes most regions worse, they are refused
///   cmstm, power 2      0.841, 0.594, 11.6 deg
///   cmstmstm, power 2   0.843, 0.600, 12.8 deg; power 4: 0.842, 0.623; power 6: 0.840, 0.638
///   stmcstmstm, 4 layers, power 4: 0.847, 0.637, 12.8 deg; power 5: 0.845, 0.644, 12.8 deg; fewer
///   tets are combined away than with c first
struct OptimizeSettings {
  /// NETGEN's steps, in order: c combine, d split, s and t swap, m smooth.
  std::string steps = "stmcstmstm";
  int rounds = 1;  ///< How often all of them, >= 1.
  /// The sum of the tets' badness to this power is made small, >= 1: more of it makes the worst
  /// tets better, and the mean a little worse.
  double error_power = 5.0;
};

/// @brief Makes tets better without touching their boundary.
class Optimizer {
 public:
  virtual ~Optimizer() = default;

  /// @note Local; may crash, exit or hang inside third-party code: run it in a job. A pure function
  /// of its arguments. The caller checks the result: nothing is promised about it but that its
  /// first `num_fixed` vertices stand for those of the input.
  /// @throws NetgenError if the optimiser gives up.
  [[nodiscard]] virtual TetMesh optimize(const OptimizeInput& input,
                                         const OptimizeSettings& settings) const = 0;
};

}  // namespace tessera::improve
