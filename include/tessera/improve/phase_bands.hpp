// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/improve/region_band.hpp"
#include "tessera/improve/seam_regions.hpp"

namespace tessera::improve {

/// @brief What is kept of a piece for one phase.
struct PhaseBands {
  std::vector<Band> bands{};       ///< make_bands()
  IndexLists tet_tags{};           ///< tets_of_bands()
  std::optional<PiecePart> rim{};  ///< For the phases to come; none if it would be too large.
};

/// @brief Takes the bands of a phase, of kDefaultLayers, out of a piece or a part of it. Local.
/// @param[in] most_of_rim A rim of more tets is left out.
[[nodiscard]] PhaseBands make_phase_bands(const PiecePart& part, const SeamRegions& regions,
                                          int phase, GlobalIndex most_of_rim);

/// @brief The *outer part* of a piece: the tets of its bands and of its rim. That is all that the
/// phase and later ones may exchange; the other tets are the piece's *core*. May have vertices that
/// no tet has: those that bands know. Local; O(n log n).
/// @pre There is a rim.
[[nodiscard]] PiecePart outer_part(const PhaseBands& kept);

}  // namespace tessera::improve
