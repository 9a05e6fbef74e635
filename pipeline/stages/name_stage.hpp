// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/part_names.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What the model holds, file length unit.
/// @note For rank 0: runs a job of it. @throws what the job fails for.
[[nodiscard]] model::ModelDescription describe_model(const config::Case& given,
                                                     RunContext& context);

/// @brief Which faces and solids of the model the case names; asks nothing of the model if the case
/// names none.
/// @note Collective: the model is described in a job of rank 0.
/// @throws ConfigError on every rank if a name fits nothing, or two fit the same.
[[nodiscard]] model::NamedParts find_named_parts(const config::Case& given, RunContext& context);

}  // namespace tessera::pipeline
