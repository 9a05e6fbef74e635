// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/fill/options.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief On how many levels a plan tests what will be subdivided.
enum class UntangleDepth : int { coarse_levels, all_levels };

/// @brief What the plan stage is to do. Borrowed.
struct UntangleWork {
  const subdomain::PartitionedMesh& cut;
  const std::vector<fill::KernelKind>& kernels;  ///< Shape (num_subdomains).
  UntangleDepth depth = UntangleDepth::coarse_levels;
  std::vector<LocalIndex> subdomains{};  ///< To test first; those around what is found follow.
};

/// @brief Finds the points that must be kept off the geometry. Without that, skins would fold, or
/// children of a subdomain that is subdivided be inverted. Works in rounds of jobs in which factors
/// only fall.
/// @param[in] limiter What is known already.
/// @note Collective; the mesh is loaded in the workers.
/// @throws MeshError on every rank if a job dies; Interrupted on a signal.
[[nodiscard]] mesh::ProjectionLimiter run_untangle_stage(const UntangleWork& work,
                                                         mesh::ProjectionLimiter limiter,
                                                         RunContext& context);

}  // namespace tessera::pipeline
