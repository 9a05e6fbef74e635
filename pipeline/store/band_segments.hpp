// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/improve/phase_bands.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"

namespace tessera::pipeline {

/// @brief The bands of a piece for a phase as segments of a record: the band of each of its
/// regions, the tags of their tets, the rim. That is empty if there is none. Local.
[[nodiscard]] std::vector<Bytes> band_segments(const improve::PhaseBands& kept);

/// @brief What a fill leaves for the improvement of a piece's seams: the segments of its record
/// from PieceSegment::core on. Local.
/// @param[in] most_of_rim A rim of more tets is left out, and then the core, too.
[[nodiscard]] std::vector<Bytes> seam_segments(const subdomain::FilledPiece& filled,
                                               const improve::SeamRegions& regions,
                                               GlobalIndex most_of_rim);

/// @brief The most tets that a rim may have. It is written and read; if it is half of the piece,
/// the piece is as good. Local.
[[nodiscard]] inline GlobalIndex most_of_rim(GlobalIndex num_tets_of_piece)
{
  return num_tets_of_piece / 2;
}

}  // namespace tessera::pipeline
