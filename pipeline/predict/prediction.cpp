// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/prediction.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/jobs/node_workers.hpp"
#include "pipeline/predict/schedule.hpp"

namespace tessera::pipeline {
namespace {

// Fork, messages, and what a rank does between two jobs.
constexpr double kJobOverhead_s = 0.003;

using TetRate = double KernelRates::*;

// Tets of a range as they are filled, each weighted with a rate of its subdomain's kernel.
double cost_of(const subdomain::SubdomainRange& range, const PredictionBasis& basis, TetRate rate)
{
  double cost = 0.0;
  for (LocalIndex s = range.first; s < range.last; ++s) {
    cost += basis.rates.of(basis.outline.kernels[at(s)]).*rate * basis.outline.filled_share()
            * static_cast<double>(basis.outline.pieces[at(s)].tets);
  }
  return cost;
}

double largest_cost(const std::vector<subdomain::SubdomainRange>& ranges,
                    const PredictionBasis& basis, TetRate rate)
{
  double largest = 0.0;
  for (const subdomain::SubdomainRange& range : ranges) {
    largest = std::max(largest, cost_of(range, basis, rate));
  }
  return largest;
}

// What adds up over the stages that ranks share. Their jobs come in the order of the run: only fill
// takes the largest first.
struct SharedTime {
  double work_s = 0.0;
  double makespan_s = 0.0;
};

void add_shared_stage(Stage stage, std::vector<double> job_s, Prediction& prediction,
                      SharedTime& shared)
{
  const double cpu_s = std::accumulate(job_s.begin(), job_s.end(), 0.0);
  for (double& duration : job_s) duration += kJobOverhead_s;
  const Schedule schedule = simulate_schedule(job_s, prediction.num_ranks);
  prediction.stages.push_back({std::string(word_of(stage)), schedule.makespan_s, cpu_s, false});
  shared.work_s += schedule.work_s;
  shared.makespan_s += schedule.makespan_s;
}

std::vector<double> durations(const std::vector<subdomain::SubdomainRange>& ranges,
                              const PredictionBasis& basis, TetRate rate)
{
  std::vector<double> job_s;
  for (const subdomain::SubdomainRange& range : ranges)
    job_s.push_back(cost_of(range, basis, rate));
  return job_s;
}

// A region's job takes as long as a fill of so many tets for each fine triangle of the seam, seen
// from both sides, by our own optimiser. Measured on shaft, 2 levels, when NETGEN did both: 10.5
// and 11.9 with 8 and 64 subdomains.
constexpr double kFilledTetsPerSeamTriangle = 11.0;

std::vector<double> improvement_durations(const PredictionBasis& basis)
{
  std::vector<double> job_s;
  for (std::size_t s = 0; s < basis.outline.seam_triangles.size(); ++s) {
    job_s.push_back(basis.rates.optimize.fill_cpu_s_per_tet * kFilledTetsPerSeamTriangle
                    * static_cast<double>(basis.outline.seam_triangles[s]));
  }
  return job_s;
}

std::vector<double> refine_durations(const RunOutline& outline)
{
  std::vector<double> job_s;
  for (const subdomain::SubdomainRange& file : outline.files) {
    job_s.push_back(kRefineCpuPerTet_s * static_cast<double>(outline.tets_of(file)));
  }
  return job_s;
}

void add_times(const PredictionBasis& basis, Prediction& prediction)
{
  double serial_s = 0.0;
  for (const StageTime& time : basis.serial_stages) {
    prediction.stages.push_back({time.name, time.rank_max_cpu_s, time.cpu_s, true});
    serial_s += time.rank_max_cpu_s;
  }
  const RunOutline& outline = basis.outline;
  std::vector<subdomain::SubdomainRange> subdomains;
  for (LocalIndex s = 0; s < static_cast<LocalIndex>(outline.kernels.size()); ++s) {
    subdomains.push_back({s, s, s + 1});
  }
  SharedTime shared;
  add_shared_stage(Stage::plan, durations(subdomains, basis, &KernelRates::plan_cpu_s_per_tet),
                   prediction, shared);
  std::vector<double> fill_s = durations(outline.jobs, basis, &KernelRates::fill_cpu_s_per_tet);
  std::ranges::sort(fill_s, std::greater<>());
  add_shared_stage(Stage::fill, std::move(fill_s), prediction, shared);
  if (outline.improves_seams) {
    add_shared_stage(Stage::improve, improvement_durations(basis), prediction, shared);
  }
  if (outline.splits_pieces()) {
    add_shared_stage(Stage::refine, refine_durations(outline), prediction, shared);
  } else if (outline.writes_from_store()) {
    add_shared_stage(Stage::write,
                     durations(outline.files, basis, &KernelRates::write_cpu_s_per_tet), prediction,
                     shared);
  }
  prediction.wall_s = serial_s + shared.makespan_s;
  prediction.serial_share = serial_s / prediction.wall_s;
  prediction.busy_share = shared.work_s / (prediction.num_ranks * shared.makespan_s);
}

void add_numbers(const RunOutline& outline, Prediction& prediction)
{
  prediction.levels = outline.levels;
  prediction.num_coarse_tets = outline.num_coarse_tets;
  prediction.num_subdomains = static_cast<GlobalIndex>(outline.pieces.size());
  prediction.num_vertices = outline.num_skeleton_vertices;
  for (const number::PieceCounts& piece : outline.pieces) {
    prediction.num_tets += piece.tets;
    prediction.num_vertices += piece.interior_vertices;
  }
  for (const subdomain::SubdomainRange& file : outline.files) {
    prediction.num_boundary_triangles += outline.boundary_triangles_of(file);
  }
}

void add_disk(const PredictionBasis& basis, Prediction& prediction)
{
  const DiskNeed need = disk_need(basis.outline, basis.rates);
  prediction.num_files = need.num_files;
  prediction.disk_bytes = need.file_bytes;
  prediction.disk_peak_bytes = need.file_bytes + need.store_bytes;
}

void add_memory(const PredictionBasis& basis, Prediction& prediction)
{
  const RunOutline& outline = basis.outline;
  GlobalIndex largest_file = 0;
  for (const subdomain::SubdomainRange& file : outline.files) {
    largest_file = std::max(largest_file, outline.tets_of(file));
  }
  const auto in_file = static_cast<double>(largest_file);
  double job = kJobBytes + largest_cost(outline.jobs, basis, &KernelRates::job_bytes_per_tet);
  if (outline.splits_pieces()) job = std::max(job, kJobBytes + kRefineBytesPerTet * in_file);
  const double jobs = std::max(basis.memory.jobs_peak, basis.memory.loaded + job);
  const double writer = outline.writes_from_store() ? kWriterBytesPerTet * in_file : 0.0;
  prediction.largest_job_bytes = basis.memory.loaded + job;
  prediction.memory_per_rank_bytes = basis.memory.process + writer + jobs;
  const bool shares_workers = basis.num_ranks >= kFewestRanksThatShare;
  prediction.memory_of_node_bytes =
      basis.memory.shared + (shares_workers ? basis.memory.loaded : 0.0);
}

}  // namespace

Prediction predict(const PredictionBasis& basis)
{
  Prediction prediction{.num_ranks = basis.num_ranks};
  add_numbers(basis.outline, prediction);
  add_disk(basis, prediction);
  add_memory(basis, prediction);
  add_times(basis, prediction);
  return prediction;
}

}  // namespace tessera::pipeline
