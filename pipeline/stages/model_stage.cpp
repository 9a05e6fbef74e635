// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model_stage.hpp"

#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

// Reading and healing take seconds even for large models; minutes mean a hang.
constexpr jobs::JobLimits kModelLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

}  // namespace

void throw_unless_read(const jobs::JobOutcome& outcome, const std::filesystem::path& file)
{
  throw_if_cancelled(outcome);
  if (was_killed_from_outside(outcome)) {
    throw MeshError(fmt::format("{}: {}{}", file.string(), outcome.message, way_on(outcome)));
  }
  const bool is_of_the_library =
      outcome.status != jobs::JobStatus::ok
      && (outcome.status != jobs::JobStatus::failed || outcome.error == ErrorKind::netgen);
  if (is_of_the_library) {
    throw GeometryError(
        fmt::format("{}: the CAD library cannot read this model: {}; repair it in a CAD program or "
                    "export it anew",
                    file.string(), outcome.message));
  }
  jobs::throw_unless_ok(outcome, file.string());
}

model::ModelSource run_model_stage(const config::Case& run_case, RunContext& context)
{
  StageScope stage(context, "model");
  const std::filesystem::path& file = run_case.geometry.file;
  model::ModelSource source = on_root(context.comm, [&] {
    const Bytes request = import_request(
        file, {run_case.coarse.feature_angle_deg, run_case.geometry.cad, run_case.geometry.smooth});
    const JobRequest job{"model", request, kModelLimits};
    jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
    auto read = read_result(outcome, from_bytes<model::ModelSource>);
    keep_if_failed(job, outcome, context);
    throw_unless_read(outcome, file);
    return std::move(*read);
  });
  all_or_none(context.comm, [&] {
    throw_unless_read(run_load("model", load_model_message(source, run_case.geometry.scale),
                               kModelLimits, context),
                      file);
  });
  stage.work_is_done();
  for (const std::string& repair : source.repairs) context.log.warn("model: {}", repair);
  stage.finish(file.filename().string());
  return source;
}

}  // namespace tessera::pipeline
