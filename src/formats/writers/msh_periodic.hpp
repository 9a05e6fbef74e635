// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "tessera/formats/piece.hpp"

namespace tessera::formats {

/// What $Periodic of MSH files holds: for each patch whose points are images, its entity, that of
/// the other patch, the transform that leads to the images, and pairs of nodes, the image first.

/// @brief The transform as MSH has it: a 4 x 4 matrix by rows. Local.
[[nodiscard]] std::array<double, 16> msh_matrix(const Affine& there);

/// @brief The binary form up to the nodes. Local. @pre !outline.periodic.empty()
/// @param[in] row Of Outline::periodic; before the first one the section begins.
[[nodiscard]] std::string msh4_periodic_head(const Outline& outline, std::size_t row);

/// @brief The same in the text of version 2.2. Local.
[[nodiscard]] std::string msh2_periodic_head(const Outline& outline, std::size_t row);

/// @brief Called with a row of Outline::periodic, how many of its points are in pieces before, and
/// the points that this piece has of it: at least one.
using VisitPeriodic =
    std::function<void(std::size_t row, GlobalIndex first, std::span<const PeriodicPoint> points)>;

/// @brief Visits what a piece has, row by row. Local.
void for_each_periodic(const Outline& outline, const Piece& piece, const VisitPeriodic& visit);

/// @brief Tags of the nodes of an image and of the point whose image it is. Local.
[[nodiscard]] std::array<GlobalIndex, 2> msh_periodic_nodes(const Piece& piece,
                                                            const PeriodicPoint& point);

inline constexpr const char* kMshEndPeriodic = "$EndPeriodic\n";

}  // namespace tessera::formats
