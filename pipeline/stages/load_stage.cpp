// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/load_stage.hpp"

#include <filesystem>
#include <utility>

#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kLoadLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 16.0};

void load_everywhere(const std::string& kind, Bytes message, RunContext& context)
{
  all_or_none(context.comm, [&] {
    jobs::JobOutcome outcome = run_load(kind, std::move(message), kLoadLimits, context);
    throw_if_cancelled(outcome);
    outcome.message += way_on(outcome);
    jobs::throw_unless_ok(outcome, "loading the " + kind);
  });
}

}  // namespace

void load_mesh(const subdomain::PartitionedMesh& cut, RunContext& context)
{
  load_everywhere("mesh", load_mesh_message(cut, context.folder), context);
}

void load_numbers(const std::vector<number::PieceCounts>& counts, const std::string& length_unit,
                  const io::OutputOptions& options, RunContext& context)
{
  load_everywhere("numbers", load_numbers_message(counts, length_unit, options), context);
}

void load_improvement(const improve::ImproveOptions& options, bool split_corners,
                      const std::vector<fill::KernelKind>& kernels, RunContext& context)
{
  load_everywhere("improvement", load_improvement_message(options, split_corners, kernels),
                  context);
}

void load_refinement(const RefineSettings& settings, const io::OutputOptions& options,
                     RunContext& context)
{
  load_everywhere("refinement", load_refinement_message(settings, options), context);
}

void load_limiter(const mesh::ProjectionLimiter& limiter, RunContext& context)
{
  load_everywhere("plan", load_limiter_message(limiter), context);
}

}  // namespace tessera::pipeline
