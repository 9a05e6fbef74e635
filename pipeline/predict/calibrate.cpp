// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/jobs/this_process.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/subdomain/count_pieces.hpp"

#include "pipeline/predict/choose_samples.hpp"
#include "pipeline/run_plan.hpp"
#include "pipeline/runtime/log.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/stages/fill/share_stage.hpp"
#include "pipeline/stages/fill/untangle_stage.hpp"
#include "pipeline/stages/output/write_stage.hpp"
#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// Where the samples write, as a run writes into its output folder. Made and removed by rank 0.
class ScratchFolder {
 public:
  ScratchFolder(fs::path folder, const comm::Communicator& comm)
      : folder_(std::move(folder)), is_mine_(comm.rank() == 0)
  {
    all_or_none(comm, [&] {
      if (!is_mine_) return;
      fs::remove_all(folder_);
      fs::create_directories(folder_ / "mesh");
      fs::create_directories(folder_ / "boundary");
    });
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    if (is_mine_) fs::remove_all(folder_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

 private:
  fs::path folder_;
  bool is_mine_;
};

double size_of(const fs::path& file)
{
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return error ? 0.0 : static_cast<double>(size);
}

// What the files of the sampled jobs have taken.
struct FileCosts {
  double mesh_bytes = 0.0;      ///< Without headers.
  double boundary_bytes = 0.0;  ///< Without headers.
  double store_bytes = 0.0;
  double header_bytes = 0.0;
  double write_cpu_s = 0.0;

  static auto fields(auto& self)
  {
    return std::tie(self.mesh_bytes, self.boundary_bytes, self.store_bytes, self.header_bytes,
                    self.write_cpu_s);
  }
};

void divide(double& rate, double cost, double number)
{
  if (number > 0.0) rate = std::max(0.0, cost) / number;
}

// Samples one kernel after the other; keeps what they measure as rates.
class Sampler {
 public:
  Sampler(const RunResult& run, const subdomain::PartitionedMesh& cut, const RunOutline& outline,
          const fs::path& folder, RunContext& context)
      : run_(run),
        cut_(cut),
        outline_(outline),
        context_(context),
        length_unit_(output_length_unit(run)),
        silent_(Progress::Style::silent, make_log({}, Verbosity::quiet)),
        own_{context.comm, context.jobs, silent_, context.log, folder},
        calibration_{built_in_rates(run.resolved.output), {}}
  {
  }

  void sample(fill::KernelKind kernel)
  {
    SampleSet set = choose(kernel);
    if (set.jobs.empty()) return;
    const subdomain::PartitionedMesh cut(cut_.coarse, cut_.decomposition,
                                         cut_.levels.limited(set.levels));
    const RunOutline outline =
        outline_run(cut, run_.kernels, outline_.files,
                    {.divides_corners = divides_corners(run_.resolved.fill, run_.kernels)});
    own_.times.clear();
    fill(set, cut, outline);
    note_work(set, outline);
    note_files(set, cut, outline);
    calibration_.samples.push_back(std::move(set));
  }

  [[nodiscard]] Calibration take() && { return std::move(calibration_); }

 private:
  [[nodiscard]] SampleSet choose(fill::KernelKind kernel) const
  {
    std::vector<subdomain::SubdomainRange> jobs;
    std::vector<double> cost_s;
    for (const subdomain::SubdomainRange& job : outline_.jobs) {
      if (run_.kernels[at(job.first)] != kernel) continue;
      jobs.push_back(job);
      cost_s.push_back(calibration_.rates.of(kernel).fill_cpu_s_per_tet * outline_.filled_share()
                       * static_cast<double>(outline_.tets_of(job)));
    }
    const SampleChoice choice = choose_samples(cost_s, outline_.fill_levels);
    SampleSet set{.kernel = kernel, .levels = choice.levels};
    for (const std::size_t row : choice.jobs) set.jobs.push_back(jobs[row]);
    return set;
  }

  // As run_pipeline() does it, with the sampled jobs in place of all. They leave no bands for the
  // improvement: its rate counts all of its work.
  void fill(SampleSet& set, const subdomain::PartitionedMesh& cut, const RunOutline& outline)
  {
    load_mesh(share_message(cut, own_), own_);
    if (outline.is_one_pass) {
      load_numbers(outline.pieces, length_unit_, run_.resolved.output, own_);
    }
    UntangleWork plan{.cut = cut, .kernels = run_.kernels};
    for (const subdomain::SubdomainRange& job : set.jobs) {
      for (LocalIndex s = job.first; s < job.last; ++s) plan.subdomains.push_back(s);
    }
    std::ranges::sort(plan.subdomains);
    const mesh::ProjectionLimiter limiter = run_untangle_stage(plan, {}, own_);
    load_limiter(limiter, own_);
    FilledPieces filled =
        run_fill_stage(run_.resolved, {cut, run_.kernels, run_.kernels, limiter, set.jobs}, own_);
    set.pieces = std::move(filled.pieces);
  }

  void note_work(SampleSet& set, const RunOutline& outline)
  {
    const StageTime& plan = own_.times.front();
    const StageTime& fill = own_.times.back();
    set.cpu_s = plan.cpu_s + fill.cpu_s;
    GlobalIndex tets = 0;
    GlobalIndex expected = 0;
    GlobalIndex interior = 0;
    for (const subdomain::PieceSummary& piece : set.pieces) {
      tets += piece.num_all_tets();
      interior += piece.num_interior_vertices;
      expected += outline.pieces[at(piece.subdomain)].tets;
    }
    GlobalIndex planned = 0;
    for (const subdomain::SubdomainRange& job : set.jobs) planned += outline.tets_of(job);
    KernelRates& rates = calibration_.rates.of(set.kernel);
    if (set.kernel != fill::KernelKind::subdivide) {
      divide(rates.tets_per_expected, static_cast<double>(tets), static_cast<double>(expected));
    }
    divide(rates.interior_vertices_per_tet, static_cast<double>(interior),
           static_cast<double>(tets));
    divide(rates.fill_cpu_s_per_tet, fill.cpu_s, static_cast<double>(tets));
    divide(rates.plan_cpu_s_per_tet, plan.cpu_s, static_cast<double>(planned));
    note_memory(set, rates);
  }

  void note_memory(const SampleSet& set, KernelRates& rates)
  {
    const double loaded =
        context_.comm.max(static_cast<double>(context_.jobs.usage().loaded_bytes));
    const double jobs_peak = own_.times.back().jobs_peak_rss_bytes;
    const GlobalIndex largest = largest_job(set);
    context_.log.debug(fmt::format("samples: {:.1f} MB are loaded, {:.1f} MB with a job of {} tets",
                                   1e-6 * loaded, 1e-6 * jobs_peak, largest));
    divide(rates.job_bytes_per_tet, jobs_peak - loaded - kJobBytes, static_cast<double>(largest));
  }

  [[nodiscard]] static const subdomain::PieceSummary* find(const SampleSet& set,
                                                           LocalIndex subdomain)
  {
    const auto found =
        std::ranges::lower_bound(set.pieces, subdomain, {}, &subdomain::PieceSummary::subdomain);
    const bool is_there = found != set.pieces.end() && found->subdomain == subdomain;
    return is_there ? &*found : nullptr;
  }

  [[nodiscard]] static GlobalIndex largest_job(const SampleSet& set)
  {
    GlobalIndex largest = 0;
    for (const subdomain::SubdomainRange& job : set.jobs) {
      GlobalIndex tets = 0;
      for (LocalIndex s = job.first; s < job.last; ++s) {
        if (const subdomain::PieceSummary* piece = find(set, s)) tets += piece->num_all_tets();
      }
      largest = std::max(largest, tets);
    }
    return largest;
  }

  void note_files(const SampleSet& set, const subdomain::PartitionedMesh& cut,
                  const RunOutline& outline)
  {
    GlobalIndex tets = 0;
    GlobalIndex boundary = 0;
    for (const subdomain::SubdomainRange& job : whole_jobs(set)) {
      for (LocalIndex s = job.first; s < job.last; ++s) {
        tets += find(set, s)->num_all_tets();
        boundary += find(set, s)->num_all_boundary();
      }
    }
    const FileCosts costs =
        on_root(context_.comm, [&] { return measure_files(set, cut, outline); });
    KernelRates& rates = calibration_.rates.of(set.kernel);
    divide(rates.file_bytes_per_tet, costs.mesh_bytes, static_cast<double>(tets));
    divide(rates.store_bytes_per_tet, costs.store_bytes, static_cast<double>(tets));
    divide(rates.write_cpu_s_per_tet, costs.write_cpu_s, static_cast<double>(tets));
    divide(calibration_.rates.file_bytes_per_boundary_triangle, costs.boundary_bytes,
           static_cast<double>(boundary));
    calibration_.rates.file_header_bytes = costs.header_bytes;
  }

  // Jobs of which every piece is there; folded ones have left no record.
  [[nodiscard]] static std::vector<subdomain::SubdomainRange> whole_jobs(const SampleSet& set)
  {
    std::vector<subdomain::SubdomainRange> whole;
    for (const subdomain::SubdomainRange& job : set.jobs) {
      bool all_there = true;
      for (LocalIndex s = job.first; s < job.last; ++s) all_there = all_there && find(set, s);
      if (all_there) whole.push_back(job);
    }
    return whole;
  }

  // On rank 0: writes the samples, unless their jobs have done so, and looks at what there is.
  [[nodiscard]] FileCosts measure_files(const SampleSet& set, const subdomain::PartitionedMesh& cut,
                                        const RunOutline& outline) const
  {
    std::vector<number::PieceCounts> counts = outline.pieces;
    for (const subdomain::PieceSummary& piece : set.pieces)
      counts[at(piece.subdomain)] = subdomain::counts_of(piece);
    const auto ids = number::IdLayout::by_host(
        mesh::HostLayout(cut.skeleton), mesh::lattice_levels(cut.skeleton, cut.levels), counts);
    const auto layers = subdomain::layer_tables(cut);
    const subdomain::WriteContext mesh{.coarse = cut.coarse,
                                       .skeleton = cut.skeleton,
                                       .ids = ids,
                                       .length_unit = length_unit_,
                                       .layers = layers ? &*layers : nullptr};
    const io::OutputOptions& options = run_.resolved.output;
    FileCosts costs;
    const fs::path empty = own_.folder / "header.vtu";
    io::write_vtu(subdomain::piece_arrays({}, mesh, options.cell_quality).tets, empty,
                  options.compression);
    costs.header_bytes = size_of(empty);
    for (const subdomain::SubdomainRange& job : whole_jobs(set)) {
      if (!outline.is_one_pass) {
        const double before_s = jobs::cpu_time_of_this_process();
        write_file(job, options, mesh, {.folder = own_.folder});
        costs.write_cpu_s += jobs::cpu_time_of_this_process() - before_s;
        costs.store_bytes +=
            size_of(store_folder(own_.folder) / (record_name(job.number) + ".record"));
      }
      const double boundary = size_of(own_.folder / subdomain::piece_path("boundary", job.number));
      costs.boundary_bytes += std::max(0.0, boundary - costs.header_bytes);
      costs.mesh_bytes +=
          size_of(own_.folder / subdomain::piece_path("mesh", job.number)) - costs.header_bytes;
    }
    return costs;
  }

  const RunResult& run_;
  const subdomain::PartitionedMesh& cut_;
  const RunOutline& outline_;
  RunContext& context_;
  std::string length_unit_;
  Progress silent_;
  RunContext own_;
  Calibration calibration_;
};

}  // namespace

Calibration calibrate(const RunResult& run, const subdomain::PartitionedMesh& cut,
                      const RunOutline& outline, const fs::path& folder, RunContext& context)
{
  const ScratchFolder scratch(folder, context.comm);
  context.progress.begin("samples", 0, "");
  Sampler sampler(run, cut, outline, folder, context);
  for (const auto& [kernel, word] : kEnumWords<fill::KernelKind>) sampler.sample(kernel);
  Calibration calibration = std::move(sampler).take();
  std::size_t num_pieces = 0;
  for (const SampleSet& set : calibration.samples) num_pieces += set.pieces.size();
  context.progress.end(fmt::format("{} pieces made and removed again", num_pieces));
  return calibration;
}

RunOutline corrected(RunOutline outline, const Calibration& calibration)
{
  for (std::size_t s = 0; s < outline.pieces.size(); ++s) {
    if (outline.kernels[s] == fill::KernelKind::subdivide) continue;
    const KernelRates& rates = calibration.rates.of(outline.kernels[s]);
    number::PieceCounts& piece = outline.pieces[s];
    const double tets = rates.tets_per_expected * static_cast<double>(piece.tets);
    // Samples are of pieces before the split, which has closed forms.
    const double vertices =
        outline.splits_pieces()
            ? rates.tets_per_expected * static_cast<double>(piece.interior_vertices)
            : rates.interior_vertices_per_tet * tets;
    piece.tets = std::llround(tets);
    piece.interior_vertices = std::llround(vertices);
  }
  for (const SampleSet& set : calibration.samples) {
    if (set.levels != outline.levels) continue;  // Also where pieces are split: by the rates.
    for (const subdomain::PieceSummary& piece : set.pieces) {
      outline.pieces[at(piece.subdomain)].tets = piece.num_all_tets();
      outline.pieces[at(piece.subdomain)].interior_vertices = piece.num_interior_vertices;
    }
  }
  return outline;
}

}  // namespace tessera::pipeline
