// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The stages in their order.
/// @note Collective. The worker processes of `context.jobs` are those of make_mesh_worker().
/// @throws what the stages throw, on every rank.
[[nodiscard]] RunResult run_pipeline(const config::Case& given, const RunOptions& options,
                                     RunContext& context);

}  // namespace tessera::pipeline
