// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/search_tree.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

/// @brief Solid angle under which a triangle is seen from `p`, positive from behind: 4 pi for all
/// of an outward surface seen from inside, 0 from outside. @cite vanoosterom1983 Local.
[[nodiscard]] double solid_angle(const std::array<Vec3, 3>& corners, const Vec3& p);

/// @brief Winding numbers of loose triangles, fast for many points @cite barill2018: how often they
/// enclose a point, 1 inside of an outward surface and 0 outside, and something between where the
/// surface has holes. Local.
///
/// Triangles that are far away beside their extent count as one dipole. A pure function of its
/// argument.
class WindingNumbers {
 public:
  /// @pre triangles is not empty; all corners are finite.
  explicit WindingNumbers(std::span<const std::array<Vec3, 3>> triangles);

  /// @brief The winding number at a point; off by a hundredth at most, and by a thousandth where it
  /// is near 1/2.
  [[nodiscard]] double at(const Vec3& point) const;

 private:
  using Corners = std::array<Vec3, 3>;
  // What the triangles of a node are from afar.
  struct Dipole {
    Vec3 centre{};
    double radius = 0.0;
    Vec3 sum{};  // Of the area vectors.
  };

  void add_dipole(std::span<const LocalIndex> triangles);
  // Nodes farther than `far` of their radii count as a dipole.
  [[nodiscard]] double sum(const Vec3& point, double far) const;

  SearchTree tree_{};
  std::vector<Corners> triangles_{};  // In the order of the leaves.
  std::vector<Dipole> dipoles_{};     // Of each node.
};

}  // namespace tessera::model
