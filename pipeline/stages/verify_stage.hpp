// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"

#include "pipeline/run_context.hpp"
#include "pipeline/stages/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Checks what the pieces say of themselves against each other: every seam closes, every
/// piece has the Euler characteristic of its coarse subdomain, no piece is missing.
/// @note Collective.
/// @throws MeshError on every rank naming the first defect.
void run_verify_stage(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                      const mesh::Skeleton& skeleton, const FilledPieces& filled,
                      RunContext& context);

}  // namespace tessera::pipeline
