// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/decompose/decompose.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Cuts the coarse mesh of a run, with its levels, into subdomains on rank 0 and gives the
/// result to all ranks.
/// @note Collective.
/// @throws ConfigError on every rank if more subdomains are asked for than there are coarse tets,
/// or if a region names an unknown material.
[[nodiscard]] decompose::DecomposeResult run_decompose_stage(const RunResult& run,
                                                             RunContext& context);

}  // namespace tessera::pipeline
