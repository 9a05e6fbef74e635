// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/estimate/rates.hpp"
#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief The samples of one kernel.
struct SampleSet {
  fill::KernelKind kernel = fill::KernelKind::netgen;
  int levels = 0;  ///< At which they were filled.
  std::vector<subdomain::SubdomainRange> jobs{};
  std::vector<subdomain::PieceSummary> pieces{};  ///< By subdomain; without those that were folded.
  double cpu_s = 0.0;
};

/// @brief What this machine needs for this model.
struct Calibration {
  Rates rates{};
  std::vector<SampleSet> samples{};  ///< One set for each kernel that the case uses.
};

/// @brief Does a few jobs of the run in earnest and measures what they cost. Plan, fill and write
/// work in a folder of their own that is removed again. The workers have no plan of the real run
/// afterwards.
/// @param[in] folder Where the samples may write for a while.
/// @note Collective. The sampled jobs are the same for every number of ranks.
/// @throws what the stages throw, on every rank.
[[nodiscard]] Calibration calibrate(const RunResult& run, const subdomain::PartitionedMesh& cut,
                                    const RunOutline& outline, const std::filesystem::path& folder,
                                    RunContext& context);

/// @brief The outline with the tets and interior vertices that are to be expected after the
/// samples. Subdomains that were sampled with all levels have what was counted. Local.
[[nodiscard]] RunOutline corrected(RunOutline outline, const Calibration& calibration);

}  // namespace tessera::pipeline
