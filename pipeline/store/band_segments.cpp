// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/band_segments.hpp"

#include <iterator>
#include <utility>

#include "tessera/subdomain/core_figures.hpp"

namespace tessera::pipeline {

std::vector<Bytes> band_segments(const improve::PhaseBands& kept)
{
  std::vector<Bytes> segments;
  for (const improve::Band& band : kept.bands) segments.push_back(to_bytes(band));
  segments.push_back(to_bytes(kept.tet_tags));
  segments.push_back(kept.rim ? to_bytes(*kept.rim) : Bytes{});
  return segments;
}

std::vector<Bytes> seam_segments(const subdomain::FilledPiece& filled,
                                 const improve::SeamRegions& regions, GlobalIndex most_of_rim)
{
  const improve::PhaseBands kept =
      improve::make_phase_bands(improve::whole_piece(filled.piece), regions, 0, most_of_rim);
  std::vector<Bytes> segments;
  segments.push_back(kept.rim ? to_bytes(subdomain::measure_core(filled, kept)) : Bytes{});
  std::ranges::move(band_segments(kept), std::back_inserter(segments));
  return segments;
}

}  // namespace tessera::pipeline
