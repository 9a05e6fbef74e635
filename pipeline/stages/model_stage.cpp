// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model_stage.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/model/options.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

// Reading and healing take seconds even for large models; minutes mean a hang.
constexpr jobs::JobLimits kModelLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

// What has a plain reader as well.
bool has_two_readers(const std::filesystem::path& file)
{
  const std::string extension = model::lower_case_extension(file);
  return extension == ".step" || extension == ".stp" || extension == ".stl";
}

// What another reader may survive. An error that the reader tells is one of the file, and limits
// are left out: whether they are met depends on the machine.
bool has_died(const jobs::JobOutcome& outcome)
{
  const bool has_ended =
      outcome.status == jobs::JobStatus::crashed || outcome.status == jobs::JobStatus::exited;
  return has_ended && !was_killed_from_outside(outcome);
}

// Lengths of the file, as import has them.
model::ImportOptions import_options(const config::Case& run_case)
{
  const config::GeometryOptions& geometry = run_case.geometry;
  model::ImportOptions options{.feature_angle_deg = run_case.coarse.feature_angle_deg,
                               .cad = geometry.cad,
                               .smooth = geometry.smooth,
                               .assembly = geometry.assembly.scaled(1.0 / geometry.scale),
                               .stl = geometry.stl};
  options.stl.wrap_tolerance /= geometry.scale;
  return options;
}

}  // namespace

model::ModelSource import_in_jobs(
    const std::filesystem::path& file, const model::ImportOptions& options,
    const std::function<jobs::JobOutcome(const std::string&, const Bytes&)>& run_import)
{
  jobs::JobOutcome outcome = run_import("model", import_request(file, options));
  std::string death;
  const bool may_be_plain =
      (has_two_readers(file) || has_two_readers(options.cad)) && !is_left_out(Repair::plain_reader);
  if (has_died(outcome) && may_be_plain) {
    jobs::JobOutcome plain =
        run_import("model_plain", import_request(file, options, model::StepReader::plain));
    if (plain.status == jobs::JobStatus::ok) death = outcome.message;
    if (!death.empty() || plain.status == jobs::JobStatus::cancelled) outcome = std::move(plain);
  }
  auto read = read_result(outcome, from_bytes<model::ModelSource>);
  throw_unless_read(outcome, file);
  if (!death.empty()) {
    note_repair(Repair::plain_reader);
    read->repairs.insert(
        read->repairs.begin(),
        fmt::format("OpenCASCADE died of it, so that the plain reader was taken: {}", death));
  }
  return std::move(*read);
}

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
  StageScope stage(context, Stage::model);
  const std::filesystem::path& file = run_case.geometry.file;
  model::ModelSource source = on_root(context.comm, [&] {
    const auto run_import = [&](const std::string& name, const Bytes& request) {
      const JobRequest job{name, request, kModelLimits};
      jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
      static_cast<void>(read_result(outcome, from_bytes<model::ModelSource>));
      keep_if_failed(job, outcome, context);
      return outcome;
    };
    return import_in_jobs(file, import_options(run_case), run_import);
  });
  all_or_none(context.comm, [&] {
    throw_unless_read(run_load("model", load_model_message(source, run_case.geometry.scale),
                               kModelLimits, context),
                      file);
  });
  stage.work_is_done();
  for (const std::string& repair : source.repairs)
    context.log.warn(fmt::format("model: {}", repair));
  stage.finish(file.filename().string());
  return source;
}

}  // namespace tessera::pipeline
