// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/store/filled_pieces.hpp"
#include "pipeline/store/run_state.hpp"

namespace tessera::pipeline {

/// @brief What is to be filled. Borrowed.
struct UntangleAndFillWork {
  const subdomain::PartitionedMesh& cut;
  const std::vector<fill::KernelKind>& kernels;          ///< Shape (num_subdomains), as wanted.
  const std::vector<subdomain::SubdomainRange>& ranges;  ///< Of subdomains that go together.
  const RunState* state = nullptr;  ///< Keeps the plan for a resumed run; nullptr: nothing does.
};

/// @brief Plans and fills. Where even subdivision finds inverted tets, plans anew for it and fills
/// what that touches, until nothing is folded.
/// @note Collective; the mesh is loaded in the workers.
/// @throws MeshError on every rank if nothing is left to hold back, because coarse tets themselves
/// are flat; what run_untangle_stage() and run_fill_stage() throw.
[[nodiscard]] LimitedPieces untangle_and_fill(const config::Case& run_case,
                                              const UntangleAndFillWork& work, RunContext& context);

/// @brief The plan after a round that left subdomains folded: these will be subdivided. It keeps
/// what their tries said. The limits are as before. Local.
[[nodiscard]] Plan with_folded_subdivided(Plan plan, const FilledPieces& filled);

/// @brief Whether fills after both plans give the same bits: kernels and limits decide, what the
/// report says of tries does not. Local.
[[nodiscard]] bool lead_to_the_same_fills(const Plan& a, const Plan& b);

}  // namespace tessera::pipeline
