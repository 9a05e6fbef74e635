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

/// @brief What a run does, chosen once, before any of its fine mesh is made.
struct RunPlan {
  /// In their order, from the model on, each once: `coarse` comes once more if sizes need a finer
  /// mesh, `plan` and `fill` if fills find folds. A resumed run may take the first ones from its
  /// folder.
  StageList stages{};
  RunOutline outline{};
  std::string length_unit{};  ///< output_length_unit().

  [[nodiscard]] bool has(Stage stage) const { return contains(stages, stage); }

  /// @brief Files that pictures may be drawn from.
  [[nodiscard]] std::vector<subdomain::SubdomainRange> files_to_draw() const
  {
    return outline.has_files ? outline.files : std::vector<subdomain::SubdomainRange>{};
  }
};

/// @brief The stages of a run of that outline. Local.
[[nodiscard]] StageList stages_of(const RunResult& run, const RunOutline& outline);

/// @brief Plans a run whose subdomains are known.
/// @note Collective.
/// @throws ConfigError on every rank, with the model's file, if the case asks for what this model
/// cannot have.
[[nodiscard]] RunPlan plan_run(const RunResult& run, const subdomain::PartitionedMesh& cut,
                               const RunOptions& options, const RunContext& context);

/// @brief The names of stages, for people: "model, coarse, …". Local.
[[nodiscard]] std::string text_of(const StageList& stages);

}  // namespace tessera::pipeline
