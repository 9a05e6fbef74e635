// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/config/case.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/size_points.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/coarse_try.hpp"

/// Which tries at the coarse mesh there are, and what each is told.
namespace tessera::pipeline {

/// @brief The tries at a coarse mesh whose surface NETGEN or Gmsh makes, best first: of CSG, of
/// parts, of `coarse.mesher = "gmsh"`. A mesh that fails at one size often works at another, so
/// after the try as asked come smaller sizes that grow more slowly, then more elements on curved
/// surfaces. The last try is on the triangles of the model instead of its faces.
[[nodiscard]] std::vector<coarse::CoarseOptions> coarse_fallbacks(
    const coarse::CoarseOptions& asked);

/// @brief What the tries of a case are told: the fallbacks, first on the parts if planes cut the
/// model; Gmsh comes last, where rank 0 finds the program.
/// @param[in] first_rung Number of the first of these tries.
/// @note Collective.
[[nodiscard]] std::vector<CoarsePlan> plans_for(const config::Case& run_case,
                                                const cut::CutTree& planes, LocalIndex first_rung,
                                                RunContext& context);

/// @brief One try more, like the one before, with more sizes at points. Local.
[[nodiscard]] CoarsePlan finer_plan(const CoarseResult& before, const mesh::SizePoints& sizes);

/// @brief What a try does that the first one does not. Local.
[[nodiscard]] RepairCounts repairs_of(const CoarsePlan& plan, const CoarsePlan& first);

/// @brief Whether there would be one try more if Gmsh were installed. Local.
[[nodiscard]] bool may_gmsh_help(const config::Case& run_case);

}  // namespace tessera::pipeline
