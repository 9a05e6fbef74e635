// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The case with coarse.max_size and refine.levels chosen from size.target, if that is
/// given.
///
/// The number of fine tets is estimated from the model's box. Levels grow with it so that the
/// serial coarse mesh stays small: each level makes it 8 times smaller. But it keeps enough tets to
/// cut.
/// @note Collective: asks the model, which is loaded in the workers, for its box.
[[nodiscard]] config::Case resolve_size(const config::Case& given, RunContext& context);

/// @brief Levels for a wanted number of fine tets: 1 below 2·10^4, 2 below 2·10^6, 3 below 10^8, 4
/// above.
[[nodiscard]] int levels_for(double num_fine_tets);

/// @brief A smaller coarse.max_size if the edges of the coarse mesh are too long for the target, or
/// nothing if it is good. On flat sides NETGEN's edges are sometimes shorter, sometimes longer than
/// the size it is given. A second mesh with a corrected size brings the middle to the same place.
///
/// Only ever smaller: where curvature or walls make edges short, the middle says nothing.
/// @param[in] target size.target. @param[in] levels Of the refinement. Local.
[[nodiscard]] std::optional<double> corrected_max_size(const mesh::CoarseMesh& coarse,
                                                       double max_size, double target, int levels);

/// @brief The largest size of the coarse mesh that fills may aim at, so that few edges are much
/// longer than size.target; infinite without a target. Local.
[[nodiscard]] double largest_coarse_size(double target, int levels);

}  // namespace tessera::pipeline
