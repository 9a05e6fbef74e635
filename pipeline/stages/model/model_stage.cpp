// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model/model_stage.hpp"

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
bool has_died(const jobs::JobEnd& end)
{
  const bool has_ended =
      end.status == jobs::JobStatus::crashed || end.status == jobs::JobStatus::exited;
  return has_ended && !was_killed_from_outside(end);
}

// Neither an error that the reader tells, nor a stop, nor a kill from outside.
bool is_of_the_library(const jobs::JobEnd& end)
{
  using jobs::JobStatus;
  if (end.status == JobStatus::failed) return end.error == ErrorKind::netgen;
  return end.status != JobStatus::ok && end.status != JobStatus::cancelled
         && !was_killed_from_outside(end);
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
    const std::function<JobResult<model::ModelSource>(const std::string&, const Bytes&)>&
        run_import)
{
  JobResult<model::ModelSource> read = run_import("model", import_request(file, options));
  std::string death;
  const bool may_be_plain =
      (has_two_readers(file) || has_two_readers(options.cad)) && !is_left_out(Repair::plain_reader);
  if (has_died(read.end) && may_be_plain) {
    auto plain = run_import("model_plain", import_request(file, options, model::StepReader::plain));
    if (plain.made) death = read.end.message;
    if (plain.made || plain.end.status == jobs::JobStatus::cancelled) read = std::move(plain);
  }
  require_read(read.end, file);
  if (!death.empty()) {
    note_repair(Repair::plain_reader);
    read.made->repairs.insert(
        read.made->repairs.begin(),
        fmt::format("OpenCASCADE died of it, so that the plain reader was taken: {}", death));
  }
  return *std::move(read.made);
}

void require_read(const jobs::JobEnd& end, const std::filesystem::path& file)
{
  jobs::JobEnd told = end;
  if (is_of_the_library(end)) {
    told = {.status = jobs::JobStatus::failed,
            .error = ErrorKind::geometry,
            .message = fmt::format("the CAD library cannot read this model: {}; repair it in a CAD "
                                   "program or export it anew",
                                   end.message)};
  }
  require_ok(told, file.string());
}

model::ModelSource run_model_stage(const config::Case& run_case, RunContext& context)
{
  StageScope stage(context, Stage::model);
  const std::filesystem::path& file = run_case.geometry.file;
  model::ModelSource source = on_root(context.comm, [&] {
    const auto run_import = [&](const std::string& name, const Bytes& request) {
      const JobRequest job{name, request, kModelLimits};
      auto read = attempt_job(job, from_bytes<model::ModelSource>, wait_for_stop_signal(), context);
      keep_if_failed(job, read.end, context);
      return read;
    };
    return import_in_jobs(file, import_options(run_case), run_import);
  });
  all_or_none(context.comm, [&] {
    require_read(run_load("model", load_model_message(source, run_case.geometry.scale),
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
