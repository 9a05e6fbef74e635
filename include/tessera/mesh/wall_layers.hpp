// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <tuple>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::mesh {

/// @brief The layers of a coarse mesh, whose tets end where the layers begin.
///
/// Each vertex on a wall has a *column*: the straight line from the vertex of the tets to the point
/// of the geometry in front of it. A fine vertex on a wall has one, too. Its point on the geometry
/// is found as without layers, and its vector is interpolated from those of the coarse vertices. So
/// heights hold on curved walls. Without layers all arrays are empty.
///
/// A *stack* says where the layers of a column end. Layers are counted from the tets to the wall,
/// of all columns alike: of a stack with fewer layers than another one, those at the tets are
/// missing.
struct WallLayers {
  /// Shape (num_vertices, 3): where the column of each coarse vertex ends, on the geometry; the
  /// vertex itself where there is no column. Output length unit.
  FlatArray<double> wall_xyz{};
  FlatArray<char> patch_is_wall{};       ///< Shape (num_patches).
  FlatArray<LocalIndex> vertex_stack{};  ///< Shape (num_vertices): that of its column, if it has
                                         ///< one.
  LocalIndex most_layers = 0;            ///< Of all stacks.
  /// Shape (num_stacks, most_layers): where the layers end, as parts of a column. The tets are at
  /// 0, as are the layers that are missing; else ascending; the last one is 1, the wall.
  FlatArray<double> ends{};

  static auto fields(auto& self)
  {
    return std::tie(self.wall_xyz, self.patch_is_wall, self.vertex_stack, self.most_layers,
                    self.ends);
  }

  /// @brief Where the layers of a stack end: its row of `ends`.
  [[nodiscard]] std::span<const double> ends_of(LocalIndex stack) const
  {
    return std::span(ends).subspan(at(stack) * at(most_layers), at(most_layers));
  }

  [[nodiscard]] bool are_none() const { return ends.empty(); }

  /// @brief Whether a patch has layers. `patch` may be kNoIndex.
  [[nodiscard]] bool is_wall(LocalIndex patch) const
  {
    return !are_none() && patch != kNoIndex && patch_is_wall[at(patch)] != 0;
  }

  /// @brief End of the column of vertex `v`. @pre !are_none().
  [[nodiscard]] Vec3 wall(LocalIndex v) const { return point_at(std::span(wall_xyz), v); }

  /// @brief Number of layers of a stack. @pre !are_none().
  [[nodiscard]] LocalIndex num_layers(LocalIndex stack) const
  {
    const auto missing = std::ranges::count(ends_of(stack), 0.0);
    return most_layers - static_cast<LocalIndex>(missing);
  }
};

}  // namespace tessera::mesh
