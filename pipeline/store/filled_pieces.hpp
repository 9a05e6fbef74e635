// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::pipeline {

class ImprovedPieces;

/// @brief One that even subdivision could not fill under this plan.
struct FoldedSubdomain {
  LocalIndex subdomain = kNoIndex;
  bool was_limited = false;  ///< A try before ended for time or memory.

  static auto fields(auto& self) { return std::tie(self.subdomain, self.was_limited); }
};

/// @brief What the improvement of seams has done.
struct Improvement {
  std::shared_ptr<const ImprovedPieces> pieces{};  ///< nullptr: they are as they were filled.
  GlobalIndex num_regions = 0;                     ///< That were tried.
  GlobalIndex num_improved = 0;  ///< Of these; the others were not better, or their job failed.
  GlobalIndex num_failed = 0;    ///< Whose own job died or found nothing valid.
  GlobalIndex num_limited = 0;   ///< Of these, for time or memory: not reproducible.
  double volume_before = 0.0;    ///< Of all pieces, output length unit cubed.
};

/// @brief What is known of all pieces; the same on every rank.
struct FilledPieces {
  std::vector<subdomain::PieceSummary> pieces{};   ///< By subdomain; without the folded ones.
  std::vector<FoldedSubdomain> folded{};           ///< By subdomain.
  std::vector<subdomain::FailedTries> failures{};  ///< Of all these; by subdomain.
  quality::QualityHistograms histograms{};         ///< Over all pieces.
  quality::WorstTets worst{};                      ///< Over all pieces.
  std::vector<Hash128> seam_sums{};  ///< Shape (num skeleton triangles): both sides' hashes, as the
                                     ///< pieces were filled.
  Improvement improvement{};
  bool are_refined = false;  ///< They were split further after the improvement.

  /// @brief Of the pieces that were made: all, or those of the subdomains asked for. Local.
  [[nodiscard]] GlobalIndex num_tets() const;
  [[nodiscard]] GlobalIndex num_cells() const;  ///< The same, with prisms in place of their tets.

  /// @brief Adds one piece of this rank's. @pre seam_sums has its shape.
  void add(const subdomain::FillResult& result);
};

/// @brief The pieces, and the limits under which they were made; the same on every rank.
struct LimitedPieces {
  FilledPieces filled{};
  mesh::ProjectionLimiter limiter{};
};

/// @brief Puts what the ranks have together; integers and sums modulo 2^64 only, so the result does
/// not depend on who had what. @note Collective.
[[nodiscard]] FilledPieces combine(FilledPieces own, const comm::Communicator& comm);

}  // namespace tessera::pipeline
