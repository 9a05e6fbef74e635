// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/mesh/damping.hpp"

#include "pipeline/cut_mesh.hpp"
#include "pipeline/filled_pieces.hpp"
#include "pipeline/piece_file.hpp"
#include "pipeline/run_context.hpp"

namespace tessera::pipeline {

/// @brief What the fill stage is to do. Borrowed.
struct FillWork {
  const CutMesh& cut;
  const std::vector<fill::KernelKind>& kernels;  ///< Shape (num_subdomains).
  const mesh::Damping& damping;                  ///< As loaded into the workers.
  const std::vector<SubdomainRange>& ranges;     ///< One job each.
};

/// @brief Refines and fills subdomains, in jobs, largest first, each by the first rung of the
/// ladder that succeeds. Ranges whose record of the store is valid are not filled again. The pieces
/// are in the store, or in their files, afterwards.
/// @note Collective.
/// @throws MeshError on every rank if all rungs fail for some subdomain; Interrupted on a signal.
[[nodiscard]] FilledPieces run_fill_stage(const config::Case& run_case, const FillWork& work,
                                          RunContext& context);

}  // namespace tessera::pipeline
