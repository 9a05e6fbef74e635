// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tessera/comm/communicator.hpp"

#include "check/findings.hpp"
#include "check/id_runs.hpp"
#include "check/records.hpp"

namespace tessera::check {

struct VertexMatch {
  std::vector<std::uint8_t>
      is_on_seam{};                  ///< Parallel to the records sent: 1 if it is in any piece.
  GlobalIndex num_vertices = 0;      ///< Different ones that a tet uses, of this rank's share.
  GlobalIndex num_shared_ids = 0;    ///< Ids that stand in several pieces, of this rank's share.
  GlobalIndex num_contradicted = 0;  ///< Of those, with more than one position.
  std::vector<PointId> ids{};        ///< Different ids of this rank's share; matching by ids only.
};

/// @brief Brings together what different pieces say about the same vertex.
/// @note Collective.
[[nodiscard]] VertexMatch match_vertices(std::span<const VertexRecord> records, Identity identity,
                                         const comm::Communicator& comm, Findings& findings);

[[nodiscard]] inline VertexKey key_of(const VertexRecord& record, Identity identity)
{
  return identity == Identity::kIds ? key_of_id(record.id) : key_of_position(record.position);
}

}  // namespace tessera::check
