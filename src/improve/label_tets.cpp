// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "tessera/improve/seam_regions.hpp"

namespace tessera::improve {
namespace {

// Region of each vertex on a seam of the phase, kNoIndex at the others.
std::vector<LocalIndex> seed_vertices(const mesh::Piece& piece, const SeamRegions& regions,
                                      int phase)
{
  std::vector<LocalIndex> vertex_region(at(piece.num_vertices()), kNoIndex);
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const LocalIndex region = regions.region_of(piece.skin_host[at(v)], piece.material);
    if (region >= regions.first_of_phase(phase) && region < regions.first_of_phase(phase + 1)) {
      vertex_region[at(v)] = region;
    }
  }
  return vertex_region;
}

// The lowest region at a tet's corners, kNoIndex if there is none.
LocalIndex lowest_at_corners(const LocalIndex* corners, const std::vector<LocalIndex>& region)
{
  LocalIndex lowest = kNoIndex;
  for (std::size_t c = 0; c < 4; ++c) {
    const LocalIndex here = region[at(corners[c])];
    if (here != kNoIndex && (lowest == kNoIndex || here < lowest)) lowest = here;
  }
  return lowest;
}

}  // namespace

std::vector<LocalIndex> label_tets(const mesh::Piece& piece, const SeamRegions& regions, int phase,
                                   int layers)
{
  std::vector<LocalIndex> vertex_region = seed_vertices(piece, regions, phase);
  std::vector<LocalIndex> tet_region(at(piece.num_tets()), kNoIndex);
  std::vector<LocalIndex> new_tets;
  for (int layer = 0; layer < layers; ++layer) {
    new_tets.clear();
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      if (tet_region[at(t)] != kNoIndex) continue;
      tet_region[at(t)] = lowest_at_corners(&piece.tet_vertices[4 * at(t)], vertex_region);
      if (tet_region[at(t)] != kNoIndex) new_tets.push_back(t);
    }
    // Vertices of this layer's tets are reached now, by the lowest region that does.
    std::vector<LocalIndex> reached = vertex_region;
    for (const LocalIndex t : new_tets) {
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex v = piece.tet_vertices[4 * at(t) + c];
        if (vertex_region[at(v)] != kNoIndex) continue;
        LocalIndex& region = reached[at(v)];
        region = region == kNoIndex ? tet_region[at(t)] : std::min(region, tet_region[at(t)]);
      }
    }
    vertex_region = std::move(reached);
  }
  return tet_region;
}

}  // namespace tessera::improve
