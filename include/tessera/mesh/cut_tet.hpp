// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tessera/mesh/tet_topology.hpp"

/// @brief How children are cut that touch something one level finer.
///
/// An edge of a child is *marked* if its midpoint is there already, because the coarse edge or
/// triangle on which it lies is one level finer. Each marked edge is parallel to one of the six
/// edges of the coarse tet, and no two of a child to the same. The order of these (longest first,
/// then by vertices) decides where a choice is left. Both sides of a face know it, so they cut the
/// face alike without a message:
///
/// - one mark: the face is bisected;
/// - two: the corner between them is cut off. The other diagonal goes from the midpoint of the
///   earlier edge to the corner opposite to it;
/// - three: four triangles, as the finer neighbour has them. To bisect such a face in order gives
///   others.
namespace tessera::mesh {

/// @brief A corner of the tet or triangle that is cut, or a midpoint. Of a tet, 0…3 are the
/// corners and 4 + e is the middle of edge e of kTetEdgeCorners. Of a triangle, 0…2 are the corners
/// and 3 + s is the middle of side s: 01, 02, 12.
using CutNode = std::uint8_t;

/// @brief Up to `kMost` simplices with N corners.
template <std::size_t N, std::size_t kMost>
class CutSimplices {
 public:
  using Simplex = std::array<CutNode, N>;

  void add(const Simplex& simplex) { simplices_[size_++] = simplex; }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] auto begin() const { return simplices_.begin(); }
  [[nodiscard]] auto end() const { return begin() + static_cast<std::ptrdiff_t>(size_); }

 private:
  std::array<Simplex, kMost> simplices_{};
  std::size_t size_ = 0;
};

using CutTets = CutSimplices<4, 8>;
using CutTriangles = CutSimplices<3, 4>;

/// @brief Place of each edge in the order of the coarse edges; only that of marked ones counts.
using TetEdgeOrder = std::array<std::uint8_t, 6>;
using SideOrder = std::array<std::uint8_t, 3>;

/// @brief Squared distances of the midpoints of opposite edges: 01–23, 02–13, 03–12.
using DiagonalLengths = std::array<double, 3>;

/// @brief Cuts a tet. All tets of the result are as positive as the tet itself.
/// @param[in] marks Bit e: edge e is marked. @pre Not all six are.
/// @param[in] diagonals Counts only with five marks, for a choice that no face shows.
[[nodiscard]] CutTets cut_tet(unsigned marks, const TetEdgeOrder& order,
                              const DiagonalLengths& diagonals);

/// @brief Cuts a triangle as cut_tet() cuts the faces of tets; all with its orientation.
/// @param[in] marks Bit s: side s is marked.
[[nodiscard]] CutTriangles cut_triangle(unsigned marks, const SideOrder& order);

}  // namespace tessera::mesh
