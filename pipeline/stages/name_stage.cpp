// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/name_stage.hpp"

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kDescribeLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

jobs::JobOutcome run_describe(const std::string& name, const Bytes& request, RunContext& context)
{
  const JobRequest job{name, request, kDescribeLimits};
  jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
  static_cast<void>(read_result(outcome, description_from_bytes));
  keep_if_failed(job, outcome, context);
  return outcome;
}

model::ModelDescription description_of(jobs::JobOutcome outcome, const config::Case& given)
{
  throw_if_cancelled(outcome);
  outcome.message += way_on(outcome);
  jobs::throw_unless_ok(outcome, given.geometry.file.string() + ": its faces and solids");
  return description_from_bytes(outcome.result);
}

// Limits are left out: whether they are met depends on the machine, and which faces a name fits may
// depend on the triangles.
bool has_failed(const jobs::JobOutcome& outcome)
{
  return outcome.status != jobs::JobStatus::ok && outcome.status != jobs::JobStatus::cancelled
         && !was_killed_from_outside(outcome) && !depends_on_machine(outcome);
}

}  // namespace

jobs::JobOutcome describe_in_jobs(
    model::Format format,
    const std::function<jobs::JobOutcome(const std::string&, const Bytes&)>& run_describe)
{
  jobs::JobOutcome outcome =
      run_describe("describe", describe_request(coarse::SurfaceMesher::netgen));
  if (format != model::Format::csg || !has_failed(outcome)) return outcome;
  jobs::JobOutcome second =
      run_describe("describe_remeshed", describe_request(coarse::SurfaceMesher::remesh));
  return has_failed(second) ? outcome : second;
}

model::ModelDescription describe_model(const config::Case& given, RunContext& context)
{
  const Bytes request = describe_request(coarse::SurfaceMesher::netgen);
  return description_of(run_describe("describe", request, context), given);
}

model::NamedParts find_named_parts(const config::Case& given, model::Format format,
                                   RunContext& context)
{
  if (given.geometry.names.empty()) return {};
  StageScope stage(context, "names");
  model::NamedParts parts = comm::on_root(context.comm, [&] {
    return with_file_context(given, [&] {
      const auto run = [&](const std::string& name, const Bytes& request) {
        return run_describe(name, request, context);
      };
      return model::find_named_parts(description_of(describe_in_jobs(format, run), given),
                                     given.geometry.names, given.geometry.scale);
    });
  });
  stage.work_is_done();
  stage.finish(fmt::format("{} faces, {} solids", parts.faces.size(), parts.solids.size()));
  return parts;
}

}  // namespace tessera::pipeline
