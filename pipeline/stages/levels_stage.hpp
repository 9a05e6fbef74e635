// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/size_points.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Chooses the levels of the coarse edges: by the sizes that the case wants, else
/// refine.levels for all. What is split after the fills has at least the levels of that split.
/// @note Collective.
/// @throws ConfigError or InputError on every rank if the sizes have no sense for this model.
void choose_levels(RunResult& run, RunContext& context);

/// @brief Where the parts of edges are longest in wanted sizes, with the levels as chosen.
/// @note Collective. @throws As choose_levels().
[[nodiscard]] sizing::PartInSizes longest_edge_in_sizes(const RunResult& run, RunContext& context);

/// @brief Where the coarse mesh should be finer, because edges would need more levels there than
/// levels are good for; empty if it is fine enough. A level cuts every edge of a tet. Next to a
/// small place in a long edge all parts of that edge become short.
/// @note Collective.
/// @throws As choose_levels().
[[nodiscard]] mesh::SizePoints sizes_for_a_finer_mesh(const RunResult& run, RunContext& context);

}  // namespace tessera::pipeline
