// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::cut {

/// @brief A plane: the points x with dot(normal, x) == offset. *Below* is where it is less.
struct Plane {
  Vec3 normal{};        ///< Of length 1.
  double offset = 0.0;  ///< File length unit.

  static auto fields(auto& self) { return std::tie(self.normal, self.offset); }
};

/// @brief Node of a binary space partition. A leaf has a part and no children.
struct CutNode {
  Plane plane{};
  LocalIndex below = kNoIndex;
  LocalIndex above = kNoIndex;
  LocalIndex part = kNoIndex;

  static auto fields(auto& self)
  {
    return std::tie(self.plane, self.below, self.above, self.part);
  }
};

/// @brief One tree a solid; leaves are parts. Parts are numbered 0…num_parts-1, hierarchically:
/// neighbours in the tree are neighbours in number.
struct CutTree {
  std::vector<LocalIndex> solid_root{};  ///< Shape (num_solids); row of nodes.
  std::vector<CutNode> nodes{};
  LocalIndex num_parts = 0;

  static auto fields(auto& self) { return std::tie(self.solid_root, self.nodes, self.num_parts); }

  /// @brief The part of a solid, from 0, that holds a point. Local.
  [[nodiscard]] LocalIndex part_of(LocalIndex solid, const Vec3& point) const;
};

}  // namespace tessera::cut
