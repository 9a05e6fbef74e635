// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief What all subdomains will hold if each is subdivided: closed forms, no piece is made.
/// Local.
/// @param[in] splits On how many levels all is split afterwards. Vertices are those before that.
[[nodiscard]] std::vector<number::PieceCounts> count_subdivided_pieces(
    const PartitionedMesh& cut, const mesh::EdgeLevels& levels, int splits = 0);

/// @brief What finished pieces hold. Local.
[[nodiscard]] number::PieceCounts counts_of(const PieceSummary& piece);
[[nodiscard]] std::vector<number::PieceCounts> counts_of(const std::vector<PieceSummary>& pieces);

}  // namespace tessera::subdomain
