// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/config/case.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/size_points.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/coarse/coarse_stage.hpp"
#include "pipeline/stages/coarse/coarse_try.hpp"

/// Which tries at the coarse mesh there are, and what each is told.
namespace tessera::pipeline {

/// @brief The tries at the coarse mesh of an uncut model, best first. The triangles of the model
/// are remeshed, then with edges of half the length; then NETGEN makes the surface. Gmsh, where the
/// case wants it, has both sizes. A mesh that the case brings is the coarse mesh; no other one
/// could be made. Local.
[[nodiscard]] std::vector<surface::CoarseOptions> coarse_tries(const config::Case& run_case);

/// @brief What the tries of a case are told: those of coarse_tries(), before them two on the parts
/// if planes cut the model; Gmsh comes last, where rank 0 finds the program.
/// @param[in] figures Of measure_model(): how long a try may take.
/// @param[in] first_rung Number of the first of these tries.
/// @note Collective.
[[nodiscard]] std::vector<CoarsePlan> plans_for(const config::Case& run_case,
                                                const std::optional<coarse::ModelFigures>& figures,
                                                const cut::CutTree& planes, LocalIndex first_rung,
                                                const RunContext& context);

/// @brief What a try does that the first one does not. Local.
[[nodiscard]] RepairCounts repairs_of(const CoarsePlan& plan, const CoarsePlan& first);

/// @brief Whether there would be one try more if Gmsh were installed. Local.
[[nodiscard]] bool may_gmsh_help(const config::Case& run_case);

}  // namespace tessera::pipeline
