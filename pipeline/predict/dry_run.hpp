// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tessera/config/case.hpp"

#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief Where in the output folder the samples of a dry run write while they are measured.
[[nodiscard]] std::filesystem::path sample_folder(const std::filesystem::path& output);

/// @brief Predicts the run of a case on so many ranks and writes prediction.json into the output
/// folder. It makes the coarse mesh and the subdomains, and does a few of the jobs to learn what
/// this machine needs for them.
/// @note Collective. All but times and memory is the same for every number of ranks that take part.
/// @return The table for people.
/// @throws what the stages throw, on every rank.
[[nodiscard]] std::string dry_run(const config::Case& given, const RunOptions& options,
                                  int num_ranks, RunContext& context);

}  // namespace tessera::pipeline
