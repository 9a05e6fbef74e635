// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/fill/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Lets no pieces pass in which subdomain::verify_pieces() sees a defect.
/// @note Collective.
/// @throws MeshError on every rank naming the first defect.
void run_verify_stage(const subdomain::PartitionedMesh& cut,
                      const std::vector<subdomain::SubdomainRange>& ranges,
                      const FilledPieces& filled, RunContext& context);

}  // namespace tessera::pipeline
