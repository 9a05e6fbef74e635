// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Checks what the pieces say of themselves against each other: no piece of the ranges is
/// missing, every seam with both sides there closes, every piece has the Euler characteristic of
/// its coarse subdomain.
/// @note Collective.
/// @throws MeshError on every rank naming the first defect.
void run_verify_stage(const subdomain::PartitionedMesh& cut,
                      const std::vector<subdomain::SubdomainRange>& ranges,
                      const FilledPieces& filled, RunContext& context);

}  // namespace tessera::pipeline
