// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"

#include "pipeline/piece_summary.hpp"
#include "pipeline/run_context.hpp"

namespace tessera::pipeline {

/// @brief What is known of all pieces; the same on every rank.
struct FilledPieces {
  std::vector<PieceSummary> pieces{};       ///< Shape (num_subdomains), by subdomain.
  quality::QualityHistograms histograms{};  ///< Over all pieces.
  std::vector<Hash128> seam_sums{};         ///< Shape (num skeleton triangles): both sides' hashes.
};

/// @brief Refines and fills all subdomains, in jobs, largest first, each by the first rung of the
/// ladder that succeeds. The pieces are in the piece store afterwards.
/// @note Collective.
/// @throws MeshError on every rank if all rungs fail for some subdomain; Interrupted on a signal.
[[nodiscard]] FilledPieces run_fill_stage(const config::Case& run_case,
                                          const mesh::Decomposition& decomposition,
                                          const mesh::Skeleton& skeleton, RunContext& context);

}  // namespace tessera::pipeline
