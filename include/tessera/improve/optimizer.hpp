// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// @brief Makes tets better without touching their boundary.
class Optimizer {
 public:
  virtual ~Optimizer() = default;

  /// @note Local; a pure function of its arguments. Promised is only that the first `num_fixed`
  /// vertices of the result stand for those of the input; the caller checks the rest.
  /// @param[in] rounds How often all of its steps are done, >= 1.
  /// @throws MeshError if the tets are no mesh.
  [[nodiscard]] virtual TetMesh optimize(const OptimizeInput& input, int rounds) const = 0;
};

}  // namespace tessera::improve
