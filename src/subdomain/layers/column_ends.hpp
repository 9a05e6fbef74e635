// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::subdomain {

/// @brief Where a layer ends on a column.
struct LayerEnd {
  double part = 0.0;  ///< Of the column, as in mesh::WallLayers::ends.
  Vec3 aside{};       ///< How far from there; output length unit.
};

/// @brief Where the layers of columns end that stand on the fine vertices of one host.
///
/// Where coarse vertices have different stacks, the ends of their layers are interpolated. So a
/// fine stack whose points are all held back is a part of the coarse one.
class ColumnEnds {
 public:
  /// @param[in] coarse Borrowed. @param[in] intervals Of the host, if it is an edge or a triangle.
  /// @pre The host is a vertex, an edge or a triangle; one of its coarse vertices has a column.
  ColumnEnds(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton, mesh::HostKind kind,
             LocalIndex row, LocalIndex intervals);

  /// @brief Those of one fine vertex, good until the next call. Shape (most_layers).
  [[nodiscard]] std::span<const LayerEnd> at_point(LocalIndex index);

 private:
  // Of the host: a coarse vertex.
  struct Corner {
    LocalIndex stack = 0;
    Vec3 column{};  ///< From the wall to the tets; zero: none.
  };

  // Barycentric coordinates of a point.
  [[nodiscard]] std::array<double, 3> weights(LocalIndex index) const;
  [[nodiscard]] LayerEnd mixed_end(const std::array<double, 3>& weight, LocalIndex layer) const;

  const mesh::WallLayers& layers_;
  mesh::HostKind kind_;
  LocalIndex intervals_;
  std::vector<Corner> corners_{};
  bool are_alike_ = true;  // Then all fine vertices have the same ends.
  std::vector<LayerEnd> ends_{};
};

}  // namespace tessera::subdomain
