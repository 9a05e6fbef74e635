// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/mesh/damping.hpp"

#include "pipeline/cut_mesh.hpp"
#include "pipeline/piece_file.hpp"
#include "pipeline/piece_summary.hpp"
#include "pipeline/run_context.hpp"

namespace tessera::pipeline {

/// @brief One that even subdivision could not fill under this plan.
struct FoldedSubdomain {
  LocalIndex subdomain = kNoIndex;
  bool was_limited = false;  ///< A try before ended for time or memory.
};

/// @brief What is known of all pieces; the same on every rank.
struct FilledPieces {
  std::vector<PieceSummary> pieces{};       ///< By subdomain; without the folded ones.
  std::vector<FoldedSubdomain> folded{};    ///< By subdomain.
  std::vector<FailedTries> failures{};      ///< Of all these; by subdomain.
  quality::QualityHistograms histograms{};  ///< Over all pieces.
  std::vector<Hash128> seam_sums{};         ///< Shape (num skeleton triangles): both sides' hashes.
};

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
