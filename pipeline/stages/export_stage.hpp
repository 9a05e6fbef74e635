// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Writes the mesh, whose piece files are complete, in the case's other formats.
/// @note Collective. @throws on every rank as formats::export_mesh().
void run_export_stage(const config::Case& run_case, RunContext& context);

}  // namespace tessera::pipeline
