// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_case.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/formats/export_mesh.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/jobs/this_process.hpp"
#include "tessera/model/options.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/piece_arrays.hpp"
#include "tessera/subdomain/read_size_field.hpp"

#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/estimate/only_subdomains.hpp"
#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/node_workers.hpp"
#include "pipeline/predict/dry_run.hpp"
#include "pipeline/predict/prediction_file.hpp"
#include "pipeline/report/mesh_view.hpp"
#include "pipeline/report/report.hpp"
#include "pipeline/report/report_page.hpp"
#include "pipeline/run_pipeline.hpp"
#include "pipeline/run_plan.hpp"
#include "pipeline/runtime/log.hpp"
#include "pipeline/runtime/terminal.hpp"
#include "pipeline/stages/model/model_stage.hpp"
#include "pipeline/store/run_state.hpp"
#include "pipeline/viewer/view_page.hpp"

namespace tessera::pipeline {
namespace {

// A build without NETGEN fills by itself, if the case says so.
void require_kernels(const fill::FillOptions& options)
{
  if (netgen::netgen_version() != "none") return;
  bool asks = options.kernel == fill::KernelKind::netgen;
  for (const fill::FillRegion& region : options.regions) {
    asks = asks || region.kernel == fill::KernelKind::netgen;
  }
  if (!asks) return;
  throw ConfigError(
      "this build of tessera has no NETGEN (it was configured with -DTESSERA_WITH_NETGEN=OFF): set "
      "fill.kernel = \"optimize\", also in every [[fill.region]]");
}

enum class Purpose : int { mesh, prediction };

// What tets of second order are not made for.
void require_order_possible(const config::Case& given, const MeshOptions& options, bool is_mesh)
{
  if (given.output.order == 1) return;
  const char* const what = !is_mesh                           ? "--dry-run"
                           : !options.only_subdomains.empty() ? "--only-subdomains"
                           : options.on_piece                 ? "MeshOptions::on_piece"
                                                              : nullptr;
  if (what == nullptr) return;
  throw ConfigError(fmt::format("{} knows tets of first order only; set output.order = 1", what));
}

// Other formats need files to be made of, and not all hold tets of second order.
void require_formats_possible(const config::Case& given, const MeshOptions& options)
{
  if (given.output.formats == std::vector{io::Format::pvtu}) return;
  for (const io::Format format : given.output.formats)
    formats::require_order_possible(format, given.output.order == 2);
  if (options.on_piece) throw ConfigError("output.formats: MeshOptions::on_piece writes no files");
}

// Before anything is done: what the case alone decides. All ranks have the same one.
void require_possible(const config::Case& given, const MeshOptions& options)
{
  static_cast<void>(left_out_repairs());  // Throws if one is none.
  const std::vector<LocalIndex>& only = options.only_subdomains;
  if (only.empty()) return;
  if (only.front() < 0 || std::ranges::adjacent_find(only, std::greater_equal{}) != only.end()) {
    throw ConfigError("--only-subdomains: not whole numbers in ascending order");
  }
  require_only_subdomains_possible(given);
}

Progress::Style progress_style(const MeshOptions& options, const comm::Communicator& comm)
{
  if (comm.rank() != 0 || options.verbosity == Verbosity::quiet) return Progress::Style::silent;
  const bool is_terminal =
      options.progress == ProgressMode::always
      || (options.progress == ProgressMode::automatic && output_ends_on_terminal());
  return is_terminal ? Progress::Style::bar : Progress::Style::lines;
}

// One run in its folder, which is locked as long as this lives.
class CaseRun {
 public:
  CaseRun(const config::Case& given, const MeshOptions& options, Purpose purpose,
          const comm::Communicator& comm, jobs::JobRunner& jobs)
      : given_(given), options_(options), purpose_(purpose), comm_(comm), jobs_(jobs)
  {
    all_or_none(comm, [&] {
      require_order_possible(given, options, is_mesh());
      require_formats_possible(given, options);
      require_possible(given, options);
    });
    is_there_ = on_root(comm, [&] { return open_folder(); });
    jobs.set_log_file(jobs_log());
  }

  MeshResult mesh()
  {
    return in_context([&](RunContext& context) {
      const NodeWorkers workers(comm_, jobs_, context.log);
      const auto ended = ended_run(context);
      return ended ? *ended : run(context);
    });
  }

  std::string predict(int num_ranks)
  {
    return in_context([&](RunContext& context) {
      return dry_run(given_, {nullptr, options_.only_subdomains}, num_ranks, context);
    });
  }

 private:
  // With log and progress; what all ranks throw is reported before it goes on.
  template <class Work>
  std::invoke_result_t<Work, RunContext&> in_context(const Work& work)
  {
    std::shared_ptr<spdlog::logger> log;
    all_or_none(comm_, [&] {
      const bool speaks = comm_.rank() == 0;
      log =
          make_log(speaks ? given_.output.directory / "log" / log_name() : "", options_.verbosity);
    });
    Progress progress(progress_style(options_, comm_), log);
    RunContext context{comm_, jobs_, progress, *log, given_.output.directory, jobs_log()};
    try {
      return work(context);
    } catch (const comm::ThrownOnAllRanks& thrown) {
      progress.clear();
      if (comm_.rank() == 0) {
        show_places(thrown.error(), context);
        report_failure(thrown.error(), context);
      }
      const ExitCode code = exit_code_of(thrown.error());
      if (code == ExitCode::stopped && is_mesh()) {
        throw comm::Collective<Interrupted>(std::string(thrown.error().what())
                                            + "; --resume goes on");
      }
      throw;
    }
  }

  [[nodiscard]] bool is_mesh() const { return purpose_ == Purpose::mesh; }

  [[nodiscard]] bool is_resumed() const
  {
    return is_mesh() && options_.existing == io::ExistingFolder::resume;
  }

  [[nodiscard]] bool has_files() const { return !options_.on_piece; }

  [[nodiscard]] std::filesystem::path jobs_log() const
  {
    return given_.output.directory / "log" / fmt::format("rank_{:06}.log", comm_.rank());
  }

  [[nodiscard]] const char* log_name() const { return is_mesh() ? "run.log" : "dry_run.log"; }

  // Whether what is asked for seems to be there already, so that nothing may be changed.
  bool open_folder()
  {
    if (is_resumed()) state().require_begun();
    netgen::require_model_file(given_.geometry.file);  // A mistyped name leaves no folder behind.
    require_kernels(given_.fill);
    io::require_compression(given_.output.compression);
    const bool is_there = options_.existing == io::ExistingFolder::refuse && is_mesh()
                          && has_files() && state().has_made(given_);
    // A dry run removes nothing that a run has left, and leaves nothing in the way of one.
    folder_.emplace(given_.output.directory,
                    is_mesh() && !is_there ? options_.existing : io::ExistingFolder::resume);
    std::filesystem::remove_all(sample_folder(given_.output.directory));
    io::make_own_folder(given_.output.directory / "log");
    if (!is_mesh() || is_there) return is_there;
    if (is_resumed()) state().require_same_case(given_);
    if (has_files()) {
      io::make_own_folder(given_.output.directory / "mesh");
      io::make_own_folder(given_.output.directory / "boundary");
    }
    io::write_text_atomically(given_.output.directory / "case.toml", config::to_toml(given_));
    return false;
  }

  [[nodiscard]] RunState state() const
  {
    return {given_.output.directory, options_.only_subdomains, has_files()};
  }

  // A run that has ended needs no more than a look at whether it is the same run.
  std::optional<MeshResult> ended_run(RunContext& context) const
  {
    if (!is_resumed() && !is_there_) return std::nullopt;
    const RunState state = this->state();
    const std::optional<MeshResult> ended = on_root(comm_,
                                                    [&] {
                                                      auto there = state.finished();
                                                      if (there && !has_files()) {
                                                        throw InputError("cannot resume " + given_.output.directory.string()
                         + ": its mesh is in files already, read_mesh() reads them");
                                                      }
                                                      return there;
                                                    });
    if (!ended) return std::nullopt;
    const model::ModelSource model = run_model_stage(given_, context);
    all_or_none(comm_, [&] {
      if (comm_.rank() != 0) return;
      const InputContent input{hash_bytes(model.content),
                               subdomain::size_field_content(given_.size)};
      if (is_there_) return state.require_same_input(input);
      state.require_same_run(input);
      state.clear();
    });
    if (ended->status == MeshStatus::degraded)
      context.log.warn(fmt::format("degraded: {}", ended->reason));
    context.log.info(fmt::format(
        "nothing to do: the run in {} has ended, with {} tets; --overwrite makes them anew",
        given_.output.directory.string(), ended->num_tets));
    return ended;
  }

  MeshResult run(RunContext& context)
  {
    const RunState state = this->state();
    const RunResult run =
        run_pipeline(given_, {&state, options_.only_subdomains, piece_sink()}, context);
    const Verdict verdict = judge(run);
    RunFigures run_figures = figures();
    all_or_none(comm_, [&] {
      if (comm_.rank() != 0) return;
      run_figures.predicted = predicted(run, run_figures, context);
      const std::string json = report_json(run, verdict, run_figures, context.times);
      write_page(json, &run);  // First: a run with a report.json has ended.
      io::write_text_atomically(given_.output.directory / "report.json", json);
      folder_->remove_half_written();  // Of jobs that were killed and done again.
      state.clear();
      // What a later try made good needs no diagnosis; a region that failed has had but one.
      if (verdict.exit_code == ExitCode::ok && run.filled.improvement.num_failed == 0) {
        std::error_code error;  // The mesh is whole and the report says so, whatever stays here.
        std::filesystem::remove_all(given_.output.directory / "failure", error);
        if (error) context.log.warn(fmt::format("failure: cannot be removed: {}", error.message()));
      }
    });
    if (comm_.rank() == 0) say(run, verdict, run_figures.wall_time_s, context.log);
    return result_of(run, verdict);
  }

  [[nodiscard]] PieceSink piece_sink() const
  {
    if (has_files()) return {};
    return [this](LocalIndex number, subdomain::PieceArrays piece) {
      options_.on_piece(subdomain::mesh_piece(std::move(piece), number));
    };
  }

  void say(const RunResult& run, const Verdict& verdict, double wall_time_s,
           spdlog::logger& log) const
  {
    for (const std::string& reason : verdict.reasons) log.warn(fmt::format("degraded: {}", reason));
    if (const auto warning = unbalanced_parts(run)) log.warn(*warning);
    log.info(fmt::format("{} tets in {} pieces, {:.1f} s: {}", run.filled.num_tets(),
                         run.filled.pieces.size(), wall_time_s, given_.output.directory.string()));
  }

  // Held against the prediction of a dry run, if there was one of this run.
  [[nodiscard]] std::vector<PredictedFigure> predicted(const RunResult& run,
                                                       const RunFigures& run_figures,
                                                       const RunContext& context) const
  {
    if (!has_files()) return {};
    GlobalIndex num_boundary = 0;
    for (const subdomain::PieceSummary& piece : run.filled.pieces)
      num_boundary += piece.num_all_boundary();
    const FolderSize size = size_of_folders(given_.output.directory, {"mesh", "boundary", "lines"});
    const ActualRun actual{
        .num_ranks = comm_.size(),
        .is_resumed = run_figures.is_resumed,
        .tets = static_cast<double>(run.num_tets),
        .vertices = static_cast<double>(run.num_vertices),
        .boundary_triangles = static_cast<double>(num_boundary),
        .files = size.num_files,
        .disk_bytes = size.bytes,
        .memory_per_rank_bytes = static_cast<double>(run_figures.peak_rss_bytes_max),
        .wall_time_s = run_figures.wall_time_s,
        .stages = context.times};
    return compare_with_prediction(given_.output.directory, PredictedRun(given_, run), actual);
  }

  // Of an STL file that could not be read or meshed, where that may be its own fault.
  void show_places(const std::exception& error, RunContext& context) const
  {
    const ErrorKind kind = kind_of(error);
    const bool is_of_model =
        kind == ErrorKind::geometry || kind == ErrorKind::mesh || kind == ErrorKind::netgen;
    const std::filesystem::path& file = given_.geometry.file;
    const bool has_coarse_mesh = std::ranges::any_of(
        context.times, [](const StageTime& time) { return time.name == word_of(Stage::coarse); });
    if (!is_mesh() || !is_of_model || has_coarse_mesh) return;
    if (model::lower_case_extension(file) == ".stl") keep_places(file, error.what(), context);
  }

  // The report of a run that has ended stays: it is what a refused --resume is judged by.
  void report_failure(const std::exception& error, const RunContext& context) const
  {
    if (!is_mesh() || state().finished()) return;
    RunFigures failed = local_figures();
    failed.peak_rss_bytes_max = peak_rss_bytes();
    const std::string json = failure_json(exit_code_of(error), error.what(), failed, context.times);
    const auto try_to = [&](const auto& write) {
      try {
        write();
      } catch (const Error& second) {
        context.log.warn(fmt::format("a report is missing: {}", second.what()));
      }
    };
    try_to([&] { io::write_text_atomically(given_.output.directory / "report.json", json); });
    try_to([&] { write_page(json, nullptr); });
  }

  static std::string view_of(const std::string& json, const RunResult& run)
  {
    return view_html(mesh_view({.patches = subdomain::names_of_rows(run.coarse.mesh),
                                .materials = mesh::body_names(run.coarse.mesh),
                                .length_unit = output_length_unit(run),
                                .report = json},
                               run.drawings.surface));
  }

  // `run`: nullptr if it has failed.
  void write_page(const std::string& json, const RunResult* run) const
  {
    if (!given_.output.report_html) return;
    const std::filesystem::path& folder = given_.output.directory;
    const ReportSource source =
        run == nullptr ? report_source(json, {}, {}, folder)
                       : report_source(json, run->drawings.pictures, view_of(json, *run), folder);
    io::write_text_atomically(folder / "report.html", report_page(source));
  }

  [[nodiscard]] std::size_t peak_rss_bytes() const
  {
    return jobs::peak_rss_of_this_process() + jobs_.peak_rss_bytes();
  }

  [[nodiscard]] RunFigures local_figures() const
  {
    const auto now = std::chrono::steady_clock::now();
    return {.case_name = options_.case_name,
            .num_ranks = comm_.size(),
            .is_resumed = is_resumed(),
            .wall_time_s = std::chrono::duration<double>(now - start_).count()};
  }

  /// Collective.
  [[nodiscard]] RunFigures figures() const
  {
    RunFigures all = local_figures();
    all.peak_rss_bytes_max =
        static_cast<std::size_t>(comm_.max(static_cast<double>(peak_rss_bytes())));
    return all;
  }

  const config::Case& given_;
  const MeshOptions& options_;
  Purpose purpose_;
  const comm::Communicator& comm_;
  jobs::JobRunner& jobs_;
  bool is_there_ = false;  // What is asked for, by a run that has ended.
  std::optional<io::OutputFolder> folder_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

MeshResult run_case(const config::Case& given, const MeshOptions& options,
                    const comm::Communicator& comm, jobs::JobRunner& jobs)
{
  return CaseRun(given, options, Purpose::mesh, comm, jobs).mesh();
}

std::string predict_case(const config::Case& given, const MeshOptions& options, int num_ranks,
                         const comm::Communicator& comm, jobs::JobRunner& jobs)
{
  return CaseRun(given, options, Purpose::prediction, comm, jobs).predict(num_ranks);
}

}  // namespace tessera::pipeline
