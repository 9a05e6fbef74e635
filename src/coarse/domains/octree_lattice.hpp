// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::coarse {

/// @brief A corner or the middle of a cell.
struct LatticePoint {
  Vec3 xyz{};
  double side = 0.0;  ///< Of the smallest cell that it is of.
};

/// @brief What octree_lattice() is told of a space. Pure functions, which are asked in several
/// threads at once.
struct LatticeSpace {
  /// Whether edges shorter than this are wanted at any of these places, which lie together.
  std::function<bool(double edge, std::span<const Vec3> places)> is_wanted_below;
  /// Whether any point within a distance of a place is. What is not may have points all the same.
  std::function<bool(const Vec3& place, double distance)> is_needed;
};

/// @brief The side of the cubes of a body-centred lattice whose edges have this root mean square: a
/// tet has two edges of one side and four of half a cube's diagonal.
[[nodiscard]] double cell_side(double rms_edge);

/// @brief The root mean square of the edges between the points of cells of this side.
[[nodiscard]] double rms_edge(double side);

/// @brief Corners and middles of the cells of an octree: in cells of one size a body-centred
/// lattice, whose Delaunay tets are all alike. Local; a pure function.
///
/// Cells are cubes of which the side is `unit` times a power of two, and lie on multiples of it, so
/// that boxes of one model have one lattice. A cell is halved where wanted edges are shorter than
/// its own by a factor of more than 1.6, and where cells beside it would be smaller by a factor
/// of more than two. Where nothing is needed cells are large.
/// @param[in] box What must be covered.
/// @param[in] unit Side of a cell, > 0. It is rounded to eight binary digits, so that differences
/// of points have few, and exact tests are fast.
/// @return Ascending by place.
/// @throws MeshError if there are too many cells.
[[nodiscard]] std::vector<LatticePoint> octree_lattice(const Box& box, double unit,
                                                       const LatticeSpace& space);

}  // namespace tessera::coarse
