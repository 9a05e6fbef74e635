// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/size_points.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Levels of the coarse edges.
struct LevelChoice {
  mesh::EdgeLevels levels{};  ///< In all.
  int splits = 0;             ///< How many of them follow after the fills; no edge has fewer.
};

/// @brief refine.levels for all edges. Local.
/// @throws ConfigError if a `[[fill.region]]` names an unknown material.
[[nodiscard]] LevelChoice uniform_levels(const config::Case& resolved,
                                         const mesh::CoarseMesh& coarse);

/// @brief Chooses the levels of the coarse edges by the sizes that the case wants.
/// @note Collective.
/// @throws ConfigError or InputError on every rank if the sizes have no sense for this model.
[[nodiscard]] LevelChoice run_levels_stage(const config::Case& resolved,
                                           const mesh::CoarseMesh& coarse, RunContext& context);

/// @brief Where the parts of edges are longest in wanted sizes, with the levels as chosen.
/// @note Collective. @throws As run_levels_stage().
[[nodiscard]] sizing::PartInSizes longest_edge_in_sizes(const RunResult& run, RunContext& context);

/// @brief Whether the coarse mesh may turn out to be too coarse for the sizes of the case. A mesh
/// of the user is as it is, and Gmsh takes no sizes at points. Local.
[[nodiscard]] bool may_want_a_finer_mesh(const config::Case& resolved);

/// @brief Where the coarse mesh should be finer, because edges would need more levels there than
/// levels are good for; empty if it is fine enough. A level cuts every edge of a tet. Next to a
/// small place in a long edge all parts of that edge become short.
/// @note Collective.
/// @throws As run_levels_stage().
/// @pre may_want_a_finer_mesh()
[[nodiscard]] mesh::SizePoints sizes_for_a_finer_mesh(const RunResult& run, RunContext& context);

}  // namespace tessera::pipeline
