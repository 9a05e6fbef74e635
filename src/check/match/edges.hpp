// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/comm/communicator.hpp"

#include "check/components.hpp"
#include "check/findings.hpp"
#include "check/match/records.hpp"

namespace tessera::check {

struct EdgeMatch {
  GlobalIndex num_edges = 0;        ///< Different ones of this rank's share.
  GlobalIndex num_halves = 0;       ///< Halves that pieces counted, but belong to one of these.
  GlobalIndex num_nonmanifold = 0;  ///< With an even number of boundary triangles above 2.
  std::vector<Link> links{};        ///< Components of the boundary joined across pieces.
};

/// @brief Brings together the boundary triangles at each edge that several pieces may have.
///
/// Reported: edges with an odd number of boundary triangles, and boundary triangles that lie on one
/// another at their common edge. Such a fold has no volume: it is the rim of a crack, where the
/// pieces' triangles do not match although they cover the same face. On the rim of a split it is
/// meant.
/// @note Collective.
[[nodiscard]] EdgeMatch match_edges(std::span<const EdgeRecord> records,
                                    const comm::Communicator& comm, Findings& findings);

/// @brief The same for edges of one piece alone. Local.
void match_own_edges(std::span<const EdgeRecord> records, EdgeMatch& match, Findings& findings);

}  // namespace tessera::check
