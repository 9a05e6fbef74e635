// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/improve/seam_regions.hpp"

namespace tessera::pipeline {

/// @brief Which segments a record of bands has: these, then the band of each of the piece's regions
/// in the phase.
enum class BandSegment : LocalIndex {
  core,  ///< subdomain::CoreFigures. Empty unless they were made of the whole piece and there is
         ///< a rim.
  tet_tags,  ///< Tags of the tets of each band.
  rim,       ///< improve::PiecePart. Empty if it would be too large.
  first_band,
};

/// @brief Takes the bands of a piece for a phase out of it, or out of a part of it that has all
/// that the phase needs. Local.
/// @param[in] most_of_rim A rim of more tets is left out.
[[nodiscard]] std::vector<Bytes> band_segments(const improve::PiecePart& part,
                                               const improve::SeamRegions& regions, int phase,
                                               GlobalIndex most_of_rim);

/// @brief The most tets that a rim may have. It is written and read; if it is half of the piece,
/// the piece is as good. Local.
[[nodiscard]] inline GlobalIndex most_of_rim(GlobalIndex num_tets_of_piece)
{
  return num_tets_of_piece / 2;
}

}  // namespace tessera::pipeline
