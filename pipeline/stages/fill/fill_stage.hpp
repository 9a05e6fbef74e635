// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {

/// @brief What the fill stage is to do. Borrowed.
struct FillWork {
  const subdomain::PartitionedMesh& cut;
  const std::vector<fill::KernelKind>& wanted;           ///< Shape (num_subdomains), by the case.
  const std::vector<fill::KernelKind>& kernels;          ///< The same, but where folds changed it.
  const mesh::ProjectionLimiter& limiter;                ///< As loaded into the workers.
  const std::vector<subdomain::SubdomainRange>& ranges;  ///< One job each.
};

/// @brief Refines and fills subdomains, in jobs, largest first, each by the first fallback
/// that succeeds. Ranges whose record of the store is valid are not filled again. The pieces
/// are in the store, or in their files, afterwards.
/// @note Collective.
/// @throws MeshError on every rank if all tries fail for some subdomain; Interrupted on a signal.
[[nodiscard]] FilledPieces run_fill_stage(const config::Case& run_case, const FillWork& work,
                                          RunContext& context);

}  // namespace tessera::pipeline
