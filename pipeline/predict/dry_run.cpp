// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/dry_run.hpp"

#include <utility>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/files.hpp"
#include "tessera/jobs/this_process.hpp"

#include "pipeline/predict/calibrate.hpp"
#include "pipeline/predict/prediction.hpp"
#include "pipeline/predict/prediction_file.hpp"
#include "pipeline/run_plan.hpp"
#include "pipeline/stages/coarse/coarse_part.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/stages/fill/share_stage.hpp"

namespace tessera::pipeline {
namespace {

RankMemory memory_before_fills(const SharedBytes& mesh, const RunContext& context)
{
  const std::size_t shared = mesh.segment() ? mesh.bytes().size() : 0;
  const jobs::JobUsage usage = context.jobs.usage();
  const auto largest = [&](std::size_t bytes) {
    return context.comm.max(static_cast<double>(bytes));
  };
  return {.process = largest(jobs::peak_rss_of_this_process()),
          .loaded = largest(usage.loaded_bytes),
          .jobs_peak = largest(context.jobs.peak_rss_bytes()),
          .shared = largest(shared)};
}

}  // namespace

std::filesystem::path sample_folder(const std::filesystem::path& output)
{
  return output / "dry_run";
}

std::string dry_run(const config::Case& given, const RunOptions& options, int num_ranks,
                    RunContext& context)
{
  RunResult run = run_coarse_part(given, {}, context);
  StageScope prepare(context, Stage::prepare);
  SharedMesh shared = share_mesh(run, context);
  const subdomain::PartitionedMesh cut(run.coarse.mesh, run.decomposition.decomposition,
                                       std::move(shared.tables));
  RunPlan plan = plan_run(run, cut, options, context);
  load_mesh(shared.message, context);
  prepare.finish("");

  PredictionBasis basis{.memory = memory_before_fills(shared.message, context),
                        .serial_stages = context.times,
                        .num_ranks = num_ranks};
  DryRun found{.stages = std::move(plan.stages)};
  found.calibration = calibrate(run, cut, plan.outline, sample_folder(context.folder), context);
  basis.outline = corrected(std::move(plan.outline), found.calibration);
  basis.rates = found.calibration.rates;
  found.prediction = predict(basis);
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    found.resources = resources_of_this_machine(context.folder, run.resolved.fill.memory_gib);
    found.advice = advise(found.prediction, found.resources);
    if (auto defect = file_too_large(basis.outline, run.resolved)) {
      found.advice.must.push_back(*std::move(defect));
    }
    io::write_text_atomically(context.folder / "prediction.json",
                              prediction_json(found, PredictedRun(given, run)));
  });
  return prediction_table(found);
}

}  // namespace tessera::pipeline
