// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tessera/coarse/model_figures.hpp"
#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What the model has that is loaded in the workers, in output length units. None if it
/// cannot be had, or if the case brings its coarse mesh and nobody asks for it.
/// @note Collective.
[[nodiscard]] std::optional<coarse::ModelFigures> measure_model(const config::Case& given,
                                                                RunContext& context);

/// @brief The case with coarse.max_size chosen from size.target, if that is given, and as many
/// levels as it takes.
///
/// The number of fine tets is estimated from the model's volume, or from its box where the volume
/// is not known (CSG). The usual number of levels grows with it so that the serial coarse mesh
/// stays small: each level makes it 8 times smaller. But it keeps enough tets to cut.
/// @param[in] figures Of measure_model().
/// @param[in] noise What is smaller in the model is merged unless the case has a size.min; output
/// length unit.
/// @note Collective: asks the model, which is loaded in the workers, for its box.
[[nodiscard]] config::Case run_size_stage(const config::Case& given,
                                          const std::optional<coarse::ModelFigures>& figures,
                                          double noise, RunContext& context);

/// @brief Number of regular tets of that edge in that volume.
[[nodiscard]] double estimated_tets(double volume, double target);

/// @brief Levels for a wanted number of fine tets: 1 below 5·10^5, 2 below 4·10^6, 3 below 10^8, 4
/// above. Fewer make better tets, more make them in less time: the coarse mesh, whose surface is
/// serial, has 60,000 tets or so at most on one or two levels.
[[nodiscard]] int levels_for(double num_fine_tets);

}  // namespace tessera::pipeline
