// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/model/model.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The stages from the model to the subdomains that the resolved case asks for. Local.
[[nodiscard]] StageList coarse_stages(const config::Case& resolved, model::Format format);

/// @brief The first stages, from the model to the subdomains: no fine work. What a stopped run has
/// kept of them is taken from its folder.
/// @note Collective.
/// @throws what the stages throw, on every rank; InputError if the folder is of another run.
[[nodiscard]] RunResult run_coarse_part(const config::Case& given, const RunOptions& options,
                                        RunContext& context);

}  // namespace tessera::pipeline
