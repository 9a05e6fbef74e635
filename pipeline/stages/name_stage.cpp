// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/name_stage.hpp"

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kDescribeLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

}  // namespace

model::ModelDescription describe_model(const config::Case& given, RunContext& context)
{
  const Bytes request = describe_request();
  const JobRequest job{"describe", request, kDescribeLimits};
  jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
  auto description = read_result(outcome, description_from_bytes);
  keep_if_failed(job, outcome, context);
  throw_if_cancelled(outcome);
  outcome.message += way_on(outcome);
  jobs::throw_unless_ok(outcome, given.geometry.file.string() + ": its faces and solids");
  return std::move(*description);
}

model::NamedParts find_named_parts(const config::Case& given, RunContext& context)
{
  if (given.geometry.names.empty()) return {};
  StageScope stage(context, "names");
  model::NamedParts parts = comm::on_root(context.comm, [&] {
    return with_file_context(given, [&] {
      return model::find_named_parts(describe_model(given, context), given.geometry.names,
                                     given.geometry.scale);
    });
  });
  stage.work_is_done();
  stage.finish(fmt::format("{} faces, {} solids", parts.faces.size(), parts.solids.size()));
  return parts;
}

}  // namespace tessera::pipeline
