// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief What is known of all pieces of a run. Borrowed.
struct PieceFacts {
  const std::vector<PieceSummary>& pieces;  ///< By subdomain.
  const std::vector<Hash128>& seam_sums;    ///< Shape (num skeleton triangles): the seam hashes of
                                            ///< both sides, as the pieces were filled.
  /// Sum over the pieces as they were filled, output length unit cubed; nothing unless they have
  /// exchanged tets since.
  std::optional<double> volume_before{};
  bool have_surfaces = false;  ///< PieceSummary::surface is known: pieces are not as filled.
};

/// @brief The first defect that pieces show when their figures are held against each other, in
/// words; nothing if there is none.
///
/// In this order:
/// - each subdomain of the ranges has one piece;
/// - a piece has positive tets only, and the Euler characteristic of its coarse subdomain;
/// - every seam with both sides there closes.
///
/// Of pieces that are not as filled, the faces of all tets cancel but for the outside. After an
/// exchange of tets the volume is what it was (rel. 1e-9).
/// @param[in] ranges Ascending; the subdomains that were asked for.
/// @note Local; linear in the coarse mesh and the pieces' number, whatever they hold.
[[nodiscard]] std::optional<std::string> verify_pieces(const PartitionedMesh& cut,
                                                       const std::vector<SubdomainRange>& ranges,
                                                       const PieceFacts& facts);

}  // namespace tessera::subdomain
