// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::cut {

/// @brief A plane: the points x with dot(normal, x) == offset. *Below* it is where that is less.
struct Plane {
  Vec3 normal{};        ///< Of length 1.
  double offset = 0.0;  ///< File length unit.

  static auto fields(auto& self) { return std::tie(self.normal, self.offset); }

  friend bool operator==(const Plane&, const Plane&) = default;

  /// @brief Distance from the plane, negative below it; file length unit. Local.
  [[nodiscard]] double height(const Vec3& point) const { return dot(normal, point) - offset; }
};

/// @brief Node of a binary space partition. A leaf has a part and no children.
struct CutNode {
  Plane plane{};
  LocalIndex below = kNoIndex;  ///< Row of CutTree::nodes.
  LocalIndex above = kNoIndex;
  LocalIndex part = kNoIndex;

  static auto fields(auto& self) { return std::tie(self.plane, self.below, self.above, self.part); }

  friend bool operator==(const CutNode&, const CutNode&) = default;

  [[nodiscard]] bool is_leaf() const { return part != kNoIndex; }
};

/// @brief How planes divide the solids of a model: one tree a solid, whose leaves are the parts.
///
/// Parts are numbered tree by tree, those below a plane before those above it. So neighbours in a
/// tree are neighbours in number.
struct CutTree {
  std::vector<LocalIndex> solid_root{};  ///< Shape (num_solids); row of nodes.
  std::vector<CutNode> nodes{};          ///< A child stands behind its parent.
  LocalIndex num_parts = 0;

  static auto fields(auto& self) { return std::tie(self.solid_root, self.nodes, self.num_parts); }

  friend bool operator==(const CutTree&, const CutTree&) = default;

  /// @brief The part that holds a point. One on a plane is above it. Local.
  /// @param solid Row of solid_root.
  [[nodiscard]] LocalIndex part_of(LocalIndex solid, const Vec3& point) const;

  /// @brief The solid of each part. Shape (num_parts); rows of solid_root. Local.
  [[nodiscard]] std::vector<LocalIndex> part_solid() const;

  /// @throws InputError if a row is out of range, a node is reached twice or never, a normal is not
  /// of length 1, or parts are not numbered as they must be.
  void require_sound() const;
};

}  // namespace tessera::cut
