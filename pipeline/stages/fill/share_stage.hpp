// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/shared_bytes.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

/// Coarse mesh, subdomains and all that follows from them are the same on all ranks: they stand
/// once in the memory of a node.
namespace tessera::pipeline {

/// @brief What all ranks and workers of a node read.
struct SharedMesh {
  SharedBytes message{};                ///< For load_mesh().
  subdomain::SubdomainTables tables{};  ///< For the levels on which pieces are filled.
};

/// @brief Puts coarse mesh and subdomains of a run and the tables of both into memory of the node,
/// and lets the run borrow them. Where a node cannot share memory, each rank has a copy; the log
/// says so.
/// @note Collective.
[[nodiscard]] SharedMesh share_mesh(RunResult& run, RunContext& context);

/// @brief The message of another mesh, which stays where it is. @note Collective.
[[nodiscard]] SharedBytes share_message(const subdomain::PartitionedMesh& cut, RunContext& context);

}  // namespace tessera::pipeline
