// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/prediction_file.hpp"

#include <algorithm>
#include <fstream>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/version.hpp"

#include "pipeline/run_plan.hpp"
#include "pipeline/store/run_state.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

double shared_cpu_s(const Prediction& prediction)
{
  double cpu_s = 0.0;
  for (const StagePrediction& stage : prediction.stages) {
    if (!stage.is_serial) cpu_s += stage.cpu_s;
  }
  return cpu_s;
}

Json quantities_json(const Prediction& prediction)
{
  return {{"ranks", prediction.num_ranks},
          {"levels", prediction.levels},
          {"coarse_tets", prediction.num_coarse_tets},
          {"subdomains", prediction.num_subdomains},
          {"tets", prediction.num_tets},
          {"vertices", prediction.num_vertices},
          {"boundary_triangles", prediction.num_boundary_triangles},
          {"files", prediction.num_files},
          {"disk_bytes", prediction.disk_bytes},
          {"disk_peak_bytes", prediction.disk_peak_bytes},
          {"memory_per_rank_bytes", prediction.memory_per_rank_bytes},
          {"memory_of_node_bytes", prediction.memory_of_node_bytes},
          {"largest_job_bytes", prediction.largest_job_bytes},
          {"cpu_s", shared_cpu_s(prediction)},
          {"wall_time_s", prediction.wall_s},
          {"serial_share", prediction.serial_share},
          {"busy_share", prediction.busy_share}};
}

Json stages_json(const Prediction& prediction)
{
  Json stages = Json::array();
  for (const StagePrediction& stage : prediction.stages) {
    stages.push_back({{"name", stage.name},
                      {"wall_time_s", stage.wall_s},
                      {"cpu_s", stage.cpu_s},
                      {"serial", stage.is_serial}});
  }
  return stages;
}

Json samples_json(const std::vector<SampleSet>& sets)
{
  Json samples = Json::array();
  for (const SampleSet& set : sets) {
    std::vector<LocalIndex> subdomains;
    for (const subdomain::SubdomainRange& job : set.jobs) {
      for (LocalIndex s = job.first; s < job.last; ++s) subdomains.push_back(s);
    }
    samples.push_back({{"kernel", word_of(set.kernel)},
                       {"levels", set.levels},
                       {"subdomains", std::move(subdomains)},
                       {"cpu_s", set.cpu_s}});
  }
  return samples;
}

Json rates_json(const Calibration& calibration)
{
  Json all = Json::object();
  for (const SampleSet& set : calibration.samples) {
    const KernelRates& rates = calibration.rates.of(set.kernel);
    all[std::string(word_of(set.kernel))] = {
        {"tets_per_expected", rates.tets_per_expected},
        {"interior_vertices_per_tet", rates.interior_vertices_per_tet},
        {"plan_cpu_s_per_tet", rates.plan_cpu_s_per_tet},
        {"fill_cpu_s_per_tet", rates.fill_cpu_s_per_tet},
        {"write_cpu_s_per_tet", rates.write_cpu_s_per_tet},
        {"job_bytes_per_tet", rates.job_bytes_per_tet},
        {"file_bytes_per_tet", rates.file_bytes_per_tet},
        {"store_bytes_per_tet", rates.store_bytes_per_tet}};
  }
  all["file_bytes_per_boundary_triangle"] = calibration.rates.file_bytes_per_boundary_triangle;
  all["file_header_bytes"] = calibration.rates.file_header_bytes;
  return all;
}

std::string bytes_text(double bytes)
{
  return bytes < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * bytes)
                     : fmt::format("{:.4g} GB", 1e-9 * bytes);
}

std::string row(const std::string& name, const std::string& value)
{
  return fmt::format("  {:<22}{}\n", name, value);
}

// Quantities that a run can look up under the same name.
std::vector<PredictedFigure> actual_figures(const ActualRun& actual)
{
  std::vector<PredictedFigure> figures{
      {.name = "tets", .actual = actual.tets},
      {.name = "vertices", .actual = actual.vertices},
      {.name = "boundary_triangles", .actual = actual.boundary_triangles},
      {.name = "files", .actual = actual.files},
      {.name = "disk_bytes", .actual = actual.disk_bytes},
      {.name = "memory_per_rank_bytes", .actual = actual.memory_per_rank_bytes}};
  return figures;
}

double total_of(const std::vector<StageTime>& times, const std::string& name,
                double StageTime::*figure)
{
  double total = 0.0;
  for (const StageTime& time : times) {
    if (time.name == name) total += time.*figure;
  }
  return total;
}

void add_times(const Json& prediction, const ActualRun& actual,
               std::vector<PredictedFigure>& figures)
{
  const bool has_same_ranks = prediction.value("ranks", 0) == actual.num_ranks;
  double cpu_s = 0.0;
  for (const Json& stage : prediction.at("stages")) {
    const auto name = stage.value("name", "");
    // Only a dry run times what a run does between its stages.
    if (std::ranges::find(actual.stages, name, &StageTime::name) == actual.stages.end()) continue;
    if (has_same_ranks) {
      figures.push_back({name + "_wall_time_s", stage.value("wall_time_s", 0.0),
                         total_of(actual.stages, name, &StageTime::wall_s)});
    }
    if (stage.value("serial", true)) continue;
    const double stage_cpu_s = total_of(actual.stages, name, &StageTime::cpu_s);
    figures.push_back({name + "_cpu_s", stage.value("cpu_s", 0.0), stage_cpu_s});
    cpu_s += stage_cpu_s;
  }
  figures.push_back({"cpu_s", prediction.value("cpu_s", 0.0), cpu_s});
  if (has_same_ranks) {
    figures.push_back({"wall_time_s", prediction.value("wall_time_s", 0.0), actual.wall_time_s});
  }
}

// All of a command that bears on the mesh.
struct HashedCase {
  std::string toml{};
  Hash128 field_content{};
  std::vector<LocalIndex> only_subdomains{};

  static auto fields(auto& self)
  {
    return std::tie(self.toml, self.field_content, self.only_subdomains);
  }
};

}  // namespace

PredictedRun::PredictedRun(const config::Case& given, const RunResult& run)
    : model_hash(to_hex(hash_bytes(run.model.content)))
{
  const HashedCase hashed{config::to_toml(without_limits(given)), run.field_content,
                          run.only_subdomains};
  case_hash = to_hex(hash_bytes(to_bytes(hashed)));
}

std::string prediction_json(const DryRun& dry_run, const PredictedRun& predicted)
{
  Json json{{"schema", 1},
            {"version", version()},
            {"case", predicted.case_hash},
            {"model", predicted.model_hash}};
  json.update(quantities_json(dry_run.prediction));
  for (const Stage stage : dry_run.stages) json["plan"].push_back(word_of(stage));
  json["stages"] = stages_json(dry_run.prediction);
  json["resources"] = {{"disk_free_bytes", dry_run.resources.free_disk_bytes},
                       {"memory_bytes", dry_run.resources.machine_memory_bytes},
                       {"cores", dry_run.resources.num_cores}};
  json["samples"] = samples_json(dry_run.calibration.samples);
  json["rates"] = rates_json(dry_run.calibration);
  json["fits"] = dry_run.advice.must.empty();
  json["must_change"] = dry_run.advice.must;
  json["should_change"] = dry_run.advice.should;
  return json.dump(1) + "\n";
}

std::string prediction_table(const DryRun& dry_run)
{
  const Prediction& prediction = dry_run.prediction;
  std::string table = fmt::format("Prediction for {} ranks\n", prediction.num_ranks);
  table += row("coarse tets",
               fmt::format("{}, {} levels", prediction.num_coarse_tets, prediction.levels));
  table += row("tets", fmt::to_string(prediction.num_tets));
  table += row("vertices", fmt::to_string(prediction.num_vertices));
  table +=
      row("pieces", fmt::format("{} in {} files", prediction.num_subdomains, prediction.num_files));
  table += row("disk",
               fmt::format("{}, {} while it runs; {} are free", bytes_text(prediction.disk_bytes),
                           bytes_text(prediction.disk_peak_bytes),
                           bytes_text(dry_run.resources.free_disk_bytes)));
  table += row("memory of a rank", fmt::format("{}, its largest job {}; this machine has {}",
                                               bytes_text(prediction.memory_per_rank_bytes),
                                               bytes_text(prediction.largest_job_bytes),
                                               bytes_text(dry_run.resources.machine_memory_bytes)));
  table += row("stages", text_of(dry_run.stages));
  for (const StagePrediction& stage : prediction.stages) {
    table += row(stage.name,
                 fmt::format("{:.2f} s{}", stage.wall_s,
                             stage.is_serial ? ", serial"
                                             : fmt::format(", {:.2f} s of CPU time", stage.cpu_s)));
  }
  table += row("all stages", fmt::format("{:.2f} s on free cores, {:.1f} % serial; ranks at work "
                                         "for {:.1f} % of the rest",
                                         prediction.wall_s, 100.0 * prediction.serial_share,
                                         100.0 * prediction.busy_share));
  for (const std::string& sentence : dry_run.advice.must)
    table += fmt::format("WILL NOT FIT: {}\n", sentence);
  for (const std::string& sentence : dry_run.advice.should)
    table += fmt::format("advice: {}\n", sentence);
  return table;
}

std::vector<PredictedFigure> compare_with_prediction(const std::filesystem::path& folder,
                                                     const PredictedRun& run,
                                                     const ActualRun& actual)
{
  if (!std::filesystem::is_regular_file(folder / "prediction.json")) return {};
  std::ifstream file(folder / "prediction.json");
  try {
    const Json prediction = Json::parse(file);
    const bool is_of_this_run = prediction.at("case") == run.case_hash
                                && prediction.at("model") == run.model_hash
                                && prediction.at("version") == version();
    if (!is_of_this_run) return {};
    std::vector<PredictedFigure> figures = actual_figures(actual);
    for (PredictedFigure& figure : figures) figure.predicted = prediction.at(figure.name);
    if (!actual.is_resumed) add_times(prediction, actual, figures);
    return figures;
  } catch (const Json::exception&) {
    return {};  // Damaged: as if there were none.
  }
}

}  // namespace tessera::pipeline
