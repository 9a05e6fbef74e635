// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The coarse mesh with room for the layers of `[[layer]]`.
/// @note Collective: a job of rank 0. @throws ConfigError on every rank as layers::grow_layers();
/// MeshError if the job fails.
[[nodiscard]] LayeredMesh run_layer_stage(const config::Case& run_case,
                                          const mesh::CoarseMesh& coarse, RunContext& context);

}  // namespace tessera::pipeline
