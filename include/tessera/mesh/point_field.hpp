// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <tuple>
#include <variant>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::mesh {

/// @brief A number at each point of a tet mesh, linear in each tet.
struct TetField {
  std::vector<double> point_xyz{};       ///< Shape (num_points, 3), output length unit.
  std::vector<LocalIndex> tet_points{};  ///< Shape (num_tets, 4), in 0…num_points-1; tets of
                                         ///< either orientation.
  std::vector<double> values{};          ///< Shape (num_points).

  static auto fields(auto& self) { return std::tie(self.point_xyz, self.tet_points, self.values); }
};

/// @brief A number at each point of a regular grid, linear along each edge of its cells.
struct GridField {
  Vec3 origin{};                       ///< First point, output length unit.
  std::array<Vec3, 3> steps{};         ///< From a point to the next; at right angles.
  std::array<LocalIndex, 3> counts{};  ///< Points in each direction, >= 2.
  std::vector<double> values{};        ///< Shape (counts[2], counts[1], counts[0]).

  static auto fields(auto& self)
  {
    return std::tie(self.origin, self.steps, self.counts, self.values);
  }
};

/// @brief Plain exchange struct between the file format (io) and its users; nothing is trusted but
/// shapes and indices.
using PointField = std::variant<TetField, GridField>;

}  // namespace tessera::mesh
