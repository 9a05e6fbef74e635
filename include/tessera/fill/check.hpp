// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/fill/kernel.hpp"

namespace tessera::fill {

/// @brief What a correct fill is known to hold.
struct FillFacts {
  std::vector<LocalIndex> triangle_tet{};  ///< Shape (num_skin_triangles); the tet behind each.
  double volume = 0.0;                     ///< Sum over the tets, output length unit cubed.
};

/// @brief Checks that tets fill a skin, whatever made them.
///
/// - The boundary of the tets is the skin, triangle for triangle.
/// - Skin vertices have not moved by a bit.
/// - All tets are positive.
/// - The tets' volume is the volume enclosed by the skin (rel. 1e-9).
/// - No vertex is unused.
/// @note Local; linear. Faces inside are matched by the sum of 64-bit hashes.
/// @throws MeshError naming the first promise that is broken and where.
[[nodiscard]] FillFacts check_fill(const FillInput& skin, const FillOutput& tets);

/// @brief Whether every tet has a positive volume. @pre vertex numbers are in range. Local.
[[nodiscard]] bool all_positive(const FillOutput& tets);

/// @brief Volume enclosed by a closed outward surface, output length unit cubed.
[[nodiscard]] double enclosed_volume(const FillInput& skin);

}  // namespace tessera::fill
