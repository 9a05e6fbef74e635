// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Draws the pictures of the report and gathers the surface that its page lets people turn.
/// They are the same for any number of ranks.
///
/// Files that the run has written are read back one at a time, as long as they are few enough: what
/// the pictures cost is bounded, whatever the size of the mesh. Else coarse triangles and tets
/// stand for them.
/// @param[in] files That hold the pieces; empty: there are no files.
/// @note Collective. @throws Interrupted on every rank.
/// @return On rank 0 the drawings; elsewhere nothing.
[[nodiscard]] Drawings run_picture_stage(const RunResult& run,
                                         const subdomain::PartitionedMesh& cut,
                                         const std::vector<subdomain::SubdomainRange>& files,
                                         RunContext& context);

}  // namespace tessera::pipeline
