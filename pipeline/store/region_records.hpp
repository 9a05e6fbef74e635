// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/improve/seam_regions.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

namespace tessera::pipeline {

/// @brief Name of a region's record.
[[nodiscard]] std::string region_name(LocalIndex region);

/// @brief What the jobs of an improvement work from. Borrowed.
struct ImproveContext {
  const subdomain::PartitionedMesh& cut;
  const improve::SeamRegions& regions;
  const io::RecordStore& store;
  int generation = 0;  ///< Of the pieces that the phase starts from.
};

/// @brief The pieces that a region lies in, from the store: regions.subdomains_of(region), in that
/// order. Local.
[[nodiscard]] std::vector<mesh::Piece> pieces_around(const ImproveContext& context,
                                                     LocalIndex region);

/// @brief The piece of a subdomain with what the regions of one phase have become. Local; runs our
/// own code only.
[[nodiscard]] mesh::Piece merge_regions(const ImproveContext& context, LocalIndex subdomain,
                                        int phase);

}  // namespace tessera::pipeline
