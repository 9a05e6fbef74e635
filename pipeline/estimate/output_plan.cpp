// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/output_plan.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/lattice.hpp"

#include "pipeline/estimate/only_subdomains.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {

std::vector<subdomain::SubdomainRange> output_ranges(const RunResult& run,
                                                     const RunOptions& options)
{
  const LocalIndex num_subdomains = run.decomposition.decomposition.num_subdomains();
  const std::vector<LocalIndex>& only = options.only_subdomains;
  const std::vector<LocalIndex>& part_offsets = run.decomposition.decomposition.part_offsets;
  if (only.empty() && !part_offsets.empty()) return subdomain::part_ranges(part_offsets);
  if (only.empty()) return subdomain::file_ranges(num_subdomains, run.resolved.output.files);
  return ranges_of_only(only, run.kernels);
}

// Of a scaled mesh only the user knows the unit.
std::string output_length_unit(const RunResult& run)
{
  return run.resolved.geometry.scale == 1.0 ? run.model.length_unit : std::string{};
}

namespace {

// A node of second order is a point of one level more.
void curve(RunOutline& outline)
{
  constexpr int kMost = mesh::lattice::kMaxLevels - 1;
  if (outline.levels > kMost) {
    throw ConfigError(fmt::format(
        "output.order = 2 leaves at most {} levels; set refine.levels = {}", kMost, kMost));
  }
  outline.curve_pieces();
}

}  // namespace

OutputPlan plan_output(const RunResult& run, const subdomain::PartitionedMesh& cut,
                       const RunOptions& options, RunContext& context)
{
  OutputPlan plan{.length_unit = output_length_unit(run)};
  all_or_none(context.comm, [&] {
    with_file_context(run.resolved, [&] {
      plan.outline = outline_run(cut, run.kernels, run.splits, output_ranges(run, options),
                                 run.resolved.improve.seams);
      if (divides_corners(run.resolved.fill, run.kernels)) plan.outline.divide_corners();
      if (options.on_piece) plan.outline.hand_over_pieces();
      if (run.resolved.output.order == 2) curve(plan.outline);
      if (const auto defect = file_too_large(plan.outline, run.resolved)) {
        throw ConfigError(*defect);
      }
    });
  });
  return plan;
}

}  // namespace tessera::pipeline
