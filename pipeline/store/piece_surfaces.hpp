// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "pipeline/store/piece_store.hpp"

namespace tessera::pipeline {

/// @brief The pieces of the store before they are split further, and what they tell each other.
/// There is no state but the folder. All functions are local.
///
/// Three steps, each for all pieces before the next one begins: every piece lists its surface; the
/// list is compared with those of its neighbours; the surroundings of a piece are known.
class PieceSurfaces {
 public:
  /// @brief The mesh is borrowed.
  /// @param[in] layers With the split, borrowed; null without layers.
  PieceSurfaces(PieceStore pieces, const subdomain::PartitionedMesh& cut,
                const subdomain::LayerTables* layers);

  void keep_list(LocalIndex subdomain) const;

  /// @brief Notes what the piece owns and what its neighbours need of it.
  /// @return What it will hold after the split.
  [[nodiscard]] number::PieceCounts compare(LocalIndex subdomain,
                                            const subdomain::PieceSplit& split) const;

  [[nodiscard]] subdomain::PieceSurroundings surroundings(LocalIndex subdomain,
                                                          const subdomain::PieceSplit& split) const;

 private:
  // What parts a body but lies on no face is a seam for the split: both sides move there.
  [[nodiscard]] LocalIndex body_of(LocalIndex subdomain) const;

  [[nodiscard]] std::vector<LocalIndex> beyond_joints(LocalIndex subdomain) const;
  void place_ends(LocalIndex n, subdomain::PieceSurroundings& around) const;

  io::RecordStore store_;
  const subdomain::PartitionedMesh& cut_;
  PieceStore pieces_;
  std::vector<std::vector<LocalIndex>> neighbours_;  ///< By subdomain, ascending.
  const subdomain::LayerTables* layers_;
  IndexLists triangles_at_{};  ///< Of the skeleton, by vertex; only if there are joints.
};

}  // namespace tessera::pipeline
