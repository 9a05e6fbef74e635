// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

/// Tets of second order: whether they are valid, by bounds that hold everywhere inside.
namespace tessera {

/// @brief Edges of a tet in the order of VTK's nodes 4…9.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kQuadraticTetEdges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// @brief Row of the edge between two corners among kQuadraticTetEdges. Local.
/// @pre a != b; both are in 0…3.
[[nodiscard]] std::size_t row_of_edge(std::size_t a, std::size_t b) noexcept;

/// @brief Row by row the corners of cells and then the nodes on their edges; the corners alone if
/// there are no nodes. Local.
/// @param[in] corners Shape (num_cells, num_corners).
/// @param[in] nodes Shape (num_cells, num_nodes), or empty.
[[nodiscard]] std::vector<LocalIndex> with_nodes(std::vector<LocalIndex> corners,
                                                 std::size_t num_corners,
                                                 const std::vector<LocalIndex>& nodes,
                                                 std::size_t num_nodes);

/// @brief Nodes of a tet of second order, in the order of VTK_QUADRATIC_TETRA.
using QuadraticTet = std::array<Vec3, 10>;

/// @brief Whether every node of an edge is the midpoint of its ends, to the bit. Local.
[[nodiscard]] bool is_straight(const QuadraticTet& tet) noexcept;

/// @brief Bézier coefficients of the Jacobian determinant, a cubic; shape (20), in the order of
/// kCubicIndices. The determinant is a mean of them everywhere, with weights that are not negative.
/// So it lies between the smallest and the largest @cite johnen2013. Local.
using JacobianCoefficients = std::array<double, 20>;
[[nodiscard]] JacobianCoefficients jacobian_coefficients(const QuadraticTet& tet) noexcept;

/// @brief Exponents of the four barycentric coordinates that belong to each coefficient.
[[nodiscard]] const std::array<std::array<int, 4>, 20>& cubic_indices() noexcept;

/// @brief Signed volume, exact but for rounding. Local.
[[nodiscard]] double curved_volume(const QuadraticTet& tet) noexcept;

/// @brief What is certain of the Jacobian determinant in a whole tet.
struct JacobianBounds {
  double smallest = 0.0;  ///< It is nowhere smaller.
  double largest = 0.0;   ///< It is nowhere larger.

  /// @brief Whether it is certainly positive everywhere.
  [[nodiscard]] bool is_positive() const noexcept { return smallest > 0.0; }

  /// @brief Smallest over largest determinant: 1 for a straight tet, not positive for one that is
  /// not valid. Never above the true value.
  [[nodiscard]] double scaled_jacobian() const noexcept
  {
    return largest > 0.0 ? smallest / largest : 0.0;
  }
};

/// @brief Bounds that are sharp to 1 % of the largest coefficient. The tet is cut in two again and
/// again where the coefficients do not decide. Rounding is allowed for: a determinant of 1e-13 of
/// what the lengths of the edges allow does not count as positive. Of a straight tet the bounds are
/// six times its volume. Local.
[[nodiscard]] JacobianBounds jacobian_bounds(const QuadraticTet& tet);

}  // namespace tessera
