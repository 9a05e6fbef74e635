// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What each file of the run holds: output.files, or the subdomains asked for. Local.
/// @throws ConfigError if only some subdomains are asked for and that is not possible. Part of a
/// mesh has ids only where the number of all other tets is known without making them.
[[nodiscard]] std::vector<subdomain::SubdomainRange> output_ranges(const RunResult& run,
                                                                   const RunOptions& options);

/// @brief Unit of the output's lengths; empty if nobody knows it. Local.
[[nodiscard]] std::string output_length_unit(const RunResult& run);

/// @brief What will come out of a run, decided before anything of it is made.
struct OutputPlan {
  RunOutline outline{};
  std::string length_unit{};  ///< output_length_unit().
};

/// @brief Plans the output of a run whose subdomains are known.
/// @note Collective.
/// @throws ConfigError on every rank, with the model's file, if the case asks for what this model
/// cannot have.
[[nodiscard]] OutputPlan plan_output(const RunResult& run, const subdomain::PartitionedMesh& cut,
                                     const RunOptions& options, RunContext& context);

}  // namespace tessera::pipeline
