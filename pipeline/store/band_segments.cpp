// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/band_segments.hpp"

#include "tessera/improve/phase_bands.hpp"
#include "tessera/subdomain/core_figures.hpp"

namespace tessera::pipeline {

std::vector<Bytes> band_segments(const improve::PiecePart& part,
                                 const improve::SeamRegions& regions, int phase,
                                 GlobalIndex most_of_rim)
{
  const improve::PhaseBands kept = improve::make_phase_bands(part, regions, phase, most_of_rim);
  std::vector<Bytes> segments(static_cast<std::size_t>(BandSegment::first_band));
  const auto segment = [&](BandSegment which) -> Bytes& {
    return segments[static_cast<std::size_t>(which)];
  };
  segment(BandSegment::tet_tags) = to_bytes(kept.tet_tags);
  if (kept.rim) segment(BandSegment::rim) = to_bytes(*kept.rim);
  if (kept.rim && part.is_whole) {
    segment(BandSegment::core) = to_bytes(subdomain::measure_core(
        part, kept, improve::vertices_perhaps_on_seams(part.piece, regions)));
  }
  for (const improve::Band& band : kept.bands) segments.push_back(to_bytes(band));
  return segments;
}

}  // namespace tessera::pipeline
