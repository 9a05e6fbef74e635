// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::surface {

/// @brief A place of a lattice of cubes: a point, or the cell from it to the next point along all
/// axes.
using LatticePlace = std::array<std::int32_t, 3>;

/// @brief The boundary between points of a lattice that are inside and those that are not: a square
/// for each edge of the lattice with ends on both sides, with a corner in each of the four cells
/// around it.
struct LatticeBoundary {
  struct Square {
    std::array<LocalIndex, 4> cells{};  ///< Seen from outside, counter-clockwise.
    Vec3 inside{};                      ///< The ends of the edge.
    Vec3 outside{};
    double share = 0.5;  ///< Where on the edge the winding number is 1/2, from inside.
  };
  std::vector<Vec3> cell_middles{};  ///< Cells ascend.
  std::vector<Square> squares{};
};

/// @brief Finds that boundary, cell by cell, without looking at the rest of the lattice. Local.
///
/// It starts from the cells that triangles touch, and follows the boundary from there, so over
/// holes too. Where points inside meet only across a diagonal, bodies that touch there are taken
/// apart, and other points are put inside until the inside is well-composed @cite latecki1997: then
/// the squares are a closed manifold.
class WrapLattice {
 public:
  using Winding = std::function<double(const Vec3&)>;

  /// @param[in] origin,spacing Of the lattice. All triangles are above the origin.
  /// @param[in] most_cells     Of how many cells it may have the corners.
  WrapLattice(const Vec3& origin, double spacing, Winding winding, std::size_t most_cells);

  /// @return Nothing if it would need more cells.
  [[nodiscard]] std::optional<LatticeBoundary> boundary(
      std::span<const std::array<Vec3, 3>> triangles);

 private:
  using Key = std::uint64_t;  // Of a place.

  // Corners of a cell that meet only across a diagonal, and those that would join them.
  struct Meeting {
    std::vector<std::size_t> inside{};
    std::vector<std::size_t> outside{};
  };

  void add_cells_of(const std::array<Vec3, 3>& triangle);
  void add_cell(const LatticePlace& cell);
  bool follow();
  void add_across_mixed_faces(const LatticePlace& cell);
  bool compose();
  [[nodiscard]] bool is_neck(const Vec3& from, const Vec3& to) const;
  void separate(const LatticePlace& cell);
  bool join(const LatticePlace& cell);
  void put(const LatticePlace& point, float winding);
  [[nodiscard]] std::vector<Meeting> meetings(const LatticePlace& cell);
  [[nodiscard]] LatticePlace extreme(const LatticePlace& cell,
                                     const std::vector<std::size_t>& corners, bool is_most);
  [[nodiscard]] double winding_at(const LatticePlace& point);
  [[nodiscard]] bool is_inside(const LatticePlace& point) { return winding_at(point) > 0.5; }
  [[nodiscard]] bool is_mixed(const LatticePlace& cell);
  [[nodiscard]] Vec3 position(const LatticePlace& point) const;
  [[nodiscard]] LatticeBoundary squares();
  void add_square(const LatticePlace& point, std::size_t axis, int direction,
                  const std::unordered_map<Key, LocalIndex>& rows, LatticeBoundary& to);

  Vec3 origin_;
  double spacing_;
  Winding winding_;
  std::size_t most_cells_;
  std::unordered_map<Key, float> winding_of_{};  // Of points.
  std::unordered_set<Key> is_known_{};           // Cells.
  std::vector<LatticePlace> cells_{};            // The same in the order in which they came.
  std::size_t num_followed_ = 0;
};

}  // namespace tessera::surface
