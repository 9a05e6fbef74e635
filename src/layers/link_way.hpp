// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::layers {

/// @brief The edges that are opposite to a vertex in its tets.
class LinkOf {
 public:
  /// @param[in] mesh Borrowed. @param[in] tets All that have the vertex.
  LinkOf(const mesh::CoarseMesh& mesh, std::span<const LocalIndex> tets, LocalIndex vertex);

  /// @brief The way along these edges whose triangles with the vertex are nearest to a plane
  /// through it. Local.
  /// @param[in] ends It ends at the nearest one of them. @param[in] is_blocked Shape
  /// (num_vertices): the other vertices that it may not have. @param[in] normal Of the plane; of
  /// length 1.
  /// @return Vertices from `first` on; empty if there is no way.
  [[nodiscard]] std::vector<LocalIndex> way(LocalIndex first, const std::set<LocalIndex>& ends,
                                            std::span<const char> is_blocked,
                                            const Vec3& normal) const;

 private:
  [[nodiscard]] double cost(LocalIndex a, LocalIndex b, const Vec3& normal) const;

  const mesh::CoarseMesh& mesh_;
  Vec3 here_;
  std::map<LocalIndex, std::set<LocalIndex>> beside_{};
};

}  // namespace tessera::layers
