// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/load_stage.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/run_job.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kMesh = "mesh";
constexpr jobs::JobLimits kLoadLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 16.0};

void require_loaded(const jobs::JobEnd& end, const std::string& kind)
{
  require_ok(end, "loading the " + kind);
}

void load_everywhere(const std::string& kind, Bytes message, RunContext& context)
{
  all_or_none(context.comm, [&] {
    require_loaded(run_load(kind, std::move(message), kLoadLimits, context), kind);
  });
}

// A worker that does not get at the memory of its rank gets a copy of what is there.
jobs::JobOutcome load_mesh_here(const SharedBytes& message, std::string& obstacle,
                                RunContext& context)
{
  if (message.segment()) {
    jobs::JobOutcome outcome =
        run_load(kMesh, message, kLoadLimits, context, load_segment_message(*message.segment()));
    if (outcome.status != jobs::JobStatus::failed) return outcome;
    obstacle = outcome.message;
  }
  return run_load(kMesh, message, kLoadLimits, context);
}

}  // namespace

void load_mesh(const SharedBytes& message, RunContext& context)
{
  std::string obstacle;
  all_or_none(context.comm,
              [&] { require_loaded(load_mesh_here(message, obstacle, context), kMesh); });
  const std::vector<std::string> obstacles = context.comm.all_gather_rows(
      obstacle.empty() ? std::vector<std::string>{} : std::vector{obstacle});
  if (obstacles.empty()) return;
  context.log.info(fmt::format("coarse mesh: workers of {} ranks have copies of it: {}",
                               obstacles.size(), obstacles.front()));
}

void load_numbers(const std::vector<number::PieceCounts>& counts, const std::string& length_unit,
                  const io::OutputOptions& options, RunContext& context)
{
  load_everywhere("numbers", load_numbers_message(counts, length_unit, options), context);
}

void load_improvement(const config::Case& run_case, const std::vector<fill::KernelKind>& kernels,
                      RunContext& context)
{
  load_everywhere("improvement",
                  load_improvement_message(run_case.improve, run_case.fill.split_corners, kernels),
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
