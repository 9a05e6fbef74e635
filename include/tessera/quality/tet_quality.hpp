// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::quality {

/// @brief The four corners of a tet, in VTK's order.
using TetCorners = std::array<Vec3, 4>;

/// @brief Mean ratio of one tetrahedron, eta = 12 (3 V)^(2/3) / sum of squared edge lengths.
///
/// Dimensionless: 1 for the regular tet, 0 for a flat one, negative for an inverted one.
///
/// @cite liu1994shape  Liu and Joe, BIT 34 (1994) 268-287, doi:10.1007/BF01955874.
/// @note Local.
[[nodiscard]] double mean_ratio(const TetCorners& corners) noexcept;

/// @brief Mean ratio of one tet, and the range of the six angles between its faces, computed
/// together. The angles are kept as cosines, since extremes of many tets need one arc cosine only.
struct TetShape {
  double mean_ratio = 0.0;
  double largest_cosine = -1.0;  ///< Of the smallest dihedral angle.
  double smallest_cosine = 1.0;  ///< Of the largest one.
};

/// @brief A face without area counts as cosines 1 and -1. @note Local.
[[nodiscard]] TetShape shape_of(const TetCorners& corners) noexcept;

/// @brief shape_of() of many tets: the same bits in less time. @note Local.
/// @param[in] xyz Shape (num_vertices, 3).
/// @param[in] tet_vertices Shape (shapes.size(), 4).
/// @param[out] shapes One a tet.
void shapes_of(std::span<const double> xyz, std::span<const LocalIndex> tet_vertices,
               std::span<TetShape> shapes) noexcept;

/// @brief Degrees in [0, 180]. @note Local.
[[nodiscard]] double angle_deg(double cosine) noexcept;

/// @brief Whole degrees of an angle, in 0…179, without an arc cosine. @note Local.
[[nodiscard]] std::size_t whole_degrees(double cosine) noexcept;

}  // namespace tessera::quality
