// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {

/// @brief Whether two subdomains of a material meet that are not subdivided. Local; O(n) in the
/// skeleton's triangles if some share one, else O(n log n).
/// @param[in] kernels By subdomain, as the case wants them.
[[nodiscard]] bool have_seams_to_improve(const subdomain::PartitionedMesh& cut,
                                         const std::vector<fill::KernelKind>& kernels);

/// @brief Optimises the tets around the seams, in jobs, across the seams. Phase by phase: first
/// around the faces between two subdomains, then around the curves where several meet, then around
/// the ends of the curves.
///
/// Subdomains exchange tets and get new vertices. The geometry and the faces between materials stay
/// as they are. A region whose job fails, or finds nothing better, keeps its tets.
///
/// Pieces are read from the store, never changed there: the updates of the regions are kept beside
/// them. Records of a run that was stopped are taken up again.
/// @pre have_seams_to_improve()
/// @param[in] kernels By subdomain, as the case wants them: what is subdivided stays as it is.
/// @param[in] filled As the fill stage returned it; all pieces are in the store.
/// @return `filled` with the figures of the improved pieces, and the way to these pieces.
/// @note Collective. @throws OutputError, Interrupted on every rank.
[[nodiscard]] FilledPieces run_improve_stage(const config::Case& run_case,
                                             const subdomain::PartitionedMesh& cut,
                                             const std::vector<fill::KernelKind>& kernels,
                                             FilledPieces filled, RunContext& context);

}  // namespace tessera::pipeline
