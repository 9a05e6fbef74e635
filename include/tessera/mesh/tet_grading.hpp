// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/cut_tet.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {

/// @brief See refined_lattice.hpp.
class RefinedLattice;

/// @brief A coarse edge as its place in the order of all edges shows it. Every process that knows
/// the edge finds the same bits.
struct EdgeRank {
  double squared_length = 0.0;
  std::array<LocalIndex, 2> vertices{};  ///< Ascending.

  /// @brief Longest first, then by vertices.
  friend bool operator<(const EdgeRank& a, const EdgeRank& b)
  {
    if (a.squared_length != b.squared_length) return a.squared_length > b.squared_length;
    return a.vertices < b.vertices;
  }
};

/// @brief Where edges are ranked that end at a coarse vertex: its position, or with layers the end
/// of its column. For there the sides of a split are at the same places. Local.
[[nodiscard]] Vec3 rank_position(const CoarseMesh& coarse, LocalIndex v);

/// @brief The same of the ends of an edge of a complex. Local.
/// @param[in] lattice Of the complex.
[[nodiscard]] std::array<Vec3, 2> rank_positions(const RefinedLattice& lattice, LocalIndex e);

/// @brief The rank of an edge between vertices `v`, in any order, at the positions `xyz`.
[[nodiscard]] EdgeRank edge_rank(std::array<LocalIndex, 2> v, std::array<Vec3, 2> xyz);

/// @brief What the children of one coarse tet are a function of, besides its points.
struct TetGrading {
  int level = 0;             ///< Of its lattice: the smallest of its edges.
  unsigned finer = 0;        ///< Bit e: edge e of kTetEdgeCorners has one level more.
  TetEdgeOrder order{};      ///< Of its edges, by edge_rank().
  std::size_t diagonal = 0;  ///< Its shortest, as lattice::for_each_child() wants it.

  /// @brief Intervals of its lattice.
  [[nodiscard]] LocalIndex intervals() const { return lattice::intervals(level); }

  [[nodiscard]] bool is_uniform() const { return finer == 0; }

  /// @brief Whether the points of one level more are there on what these corners span: on edges
  /// that are finer, and on faces with three of them.
  /// @param[in] corners Bit c: corner c.
  [[nodiscard]] bool is_finer_on(unsigned corners) const
  {
    return (finer_supports_ >> corners & 1U) != 0;
  }

  /// @param[in] corners Positions. @param[in] ranked Where edges are ranked: rank_position().
  /// @param[in] vertices In an order that is the same for all tets.
  /// @param[in] levels Of the edges, in the order of kTetEdgeCorners; they differ by one at most.
  [[nodiscard]] static TetGrading of(const std::array<Vec3, 4>& corners,
                                     const std::array<Vec3, 4>& ranked,
                                     const std::array<LocalIndex, 4>& vertices,
                                     const std::array<int, 6>& levels);

 private:
  std::uint16_t finer_supports_ = 0;
};

/// @brief That of a coarse tet. Local.
[[nodiscard]] TetGrading tet_grading(const CoarseMesh& coarse, const EdgeLevels& levels,
                                     LocalIndex tet);

/// @brief Number of children, in closed form: n^3 with n intervals if no edge is finer, k n more if
/// k edges are but no face is (with n > 1). Local; O(1).
[[nodiscard]] GlobalIndex num_children(const TetGrading& grading);

}  // namespace tessera::mesh
