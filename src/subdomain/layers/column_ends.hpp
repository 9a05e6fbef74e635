// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::subdomain {

/// @brief Where the layers of columns end that stand on the fine vertices of one host, as parts of
/// a column: mesh::WallLayers::ends.
///
/// Where coarse vertices have different stacks, the heights of layers are interpolated between
/// them.
class ColumnEnds {
 public:
  /// @param[in] coarse Borrowed. @param[in] intervals Of the host, if it is an edge or a triangle.
  /// @pre The mesh has layers; the host is a vertex, an edge or a triangle.
  ColumnEnds(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton, mesh::HostKind kind,
             LocalIndex row, LocalIndex intervals);

  /// @brief Those of one fine vertex, good until the next call. Shape (most_layers).
  [[nodiscard]] std::span<const double> at_point(LocalIndex index);

 private:
  struct Corner {
    LocalIndex stack = 0;
    double length = 0.0;  ///< Of its column; 0: none.
  };

  // Barycentric coordinates of a point, times the intervals.
  [[nodiscard]] std::array<double, 3> weights(LocalIndex index) const;

  const mesh::WallLayers& layers_;
  mesh::HostKind kind_;
  LocalIndex intervals_;
  std::vector<Corner> corners_{};
  LocalIndex common_stack_ = 0;
  bool are_alike_ = true;  // Then it is that of all.
  std::vector<double> mixed_{};
};

}  // namespace tessera::subdomain
