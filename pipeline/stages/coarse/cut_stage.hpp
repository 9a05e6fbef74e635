// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "tessera/cut/choose_planes.hpp"
#include "tessera/model/description.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Whether planes were chosen for the model of a run. Local.
[[nodiscard]] inline bool is_cut(const RunResult& run) { return run.planes.tree.num_parts > 0; }

/// @brief What to say if the parts could not be meshed. Local.
[[nodiscard]] std::optional<std::string> parts_not_meshed(const RunResult& run);

/// @brief The planes that cut the model of a run before it is meshed, chosen on rank 0.
/// @note Collective: the model is described in a job of rank 0.
/// @throws ConfigError on every rank if the model has no solids that could be cut, or a given plane
/// meets none.
[[nodiscard]] cut::CutChoice run_cut_stage(const RunResult& run, RunContext& context);

/// @brief Wanted number of parts of a model: as many as subdomains are asked for. With "auto", as
/// many as the coarse mesh is worth, or, if planes are given, those that they make. Local.
[[nodiscard]] LocalIndex num_parts_for(const config::Case& resolved,
                                       const model::ModelDescription& model);

}  // namespace tessera::pipeline
