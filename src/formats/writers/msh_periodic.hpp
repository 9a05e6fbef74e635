// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tessera/formats/piece.hpp"

#include "formats/periodic_nodes.hpp"

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

inline constexpr const char* kMshEndPeriodic = "$EndPeriodic\n";

}  // namespace tessera::formats
