// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The coarse mesh with the sides of `[[periodic]]` as images of each other.
/// @note Collective. @throws on every rank as topology::join_periodic_sides().
[[nodiscard]] mesh::CoarseMesh run_periodic_stage(const config::Case& run_case,
                                                  const mesh::CoarseMesh& coarse,
                                                  RunContext& context);

}  // namespace tessera::pipeline
