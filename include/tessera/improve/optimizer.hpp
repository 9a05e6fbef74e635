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
  /// Shape (num_triangles): RegionMesh::triangle_outside. Triangles on the geometry have kNoIndex.
  const std::vector<LocalIndex>& triangle_outside;
};

/// @brief What an optimiser does.
///
/// Measured on seams of 64 subdomains (shaft, L = 2, 159 k tets), all three phases, power 5. With
/// one subdomain the mesh has 0.870, 0.675, 19.4 deg, and the fill takes 5.8 s. Columns: mean of
/// the mean ratio, its 1st percentile, smallest angle, Kolmogorov-Smirnov distance of seam tets and
/// others, CPU time.
///   as filled               0.844, 0.591, 11.5 deg, 0.208
///   stm, 2 layers           0.857, 0.663, 19.2 deg, 0.086, 2.7 s
///   stmcstm, 2 layers       0.863, 0.683, 16.0 deg, 0.033, 5.8 s
///   stmcstm, 3 layers       0.866, 0.690, 17.4 deg, 0.031, 8.4 s
///   stmcstm, 4 layers       0.868, 0.693, 18.5 deg, 0.036, 11.3 s
///   stmcstmstm, 4 layers    0.869, 0.695, 18.3 deg, 0.030, 15.2 s
/// On boxcyl (0.886, 0.704, 22.3 deg) 2 layers lose 6 % of the percentile, 3 layers 4 %. Split (d)
/// makes most regions worse, so that they are refused.
struct OptimizeSettings {
  /// NETGEN's steps, in order: c combine, d split, s and t swap, m smooth.
  std::string steps = "stmcstm";
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
  /// of its arguments. Promised is only that the first `num_fixed` vertices of the result stand for
  /// those of the input; the caller checks the rest.
  /// @throws NetgenError if the optimiser gives up.
  [[nodiscard]] virtual TetMesh optimize(const OptimizeInput& input,
                                         const OptimizeSettings& settings) const = 0;
};

}  // namespace tessera::improve
