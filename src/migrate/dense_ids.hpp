// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::migrate {

/// @brief Whether the ids of all ranks together are 0…n-1, each once. By hashes: no id is sent.
/// @note Collective.
[[nodiscard]] bool are_dense(const comm::Communicator& comm, std::span<const GlobalIndex> ids);

/// @brief `ids` if they are there and dense over all ranks, else new ids: by rank, then by row.
/// @note Collective.
/// @param[in] ids Nothing if this rank has none.
[[nodiscard]] std::vector<GlobalIndex> dense_ids(const comm::Communicator& comm,
                                                 std::optional<std::vector<GlobalIndex>> ids,
                                                 std::size_t num_rows);

}  // namespace tessera::migrate
