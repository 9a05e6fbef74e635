// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/mesh_command.hpp"

#include <chrono>
#include <cstring>
#include <optional>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/config/case.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/output_folder.hpp"
#include "tessera/jobs/this_process.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/commands/report.hpp"
#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/estimate/only_subdomains.hpp"
#include "pipeline/predict/dry_run.hpp"
#include "pipeline/predict/prediction_file.hpp"
#include "pipeline/run_pipeline.hpp"
#include "pipeline/runtime/log.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/store/run_state.hpp"

namespace tessera::pipeline {
namespace {

// What a solver may expect of output.parts without a word; 1.06 was measured with 16 subdomains a
// part.
constexpr double kMostBalance = 1.1;

Bytes bytes_of(const std::string& text)
{
  Bytes bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::string_view text_of(const Bytes& bytes)
{
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Rank 0 reads the file; the others get the resolved text, so no rank can see another case.
config::Case read_case(const MeshCommand& command, const comm::Communicator& comm)
{
  const Bytes text = on_root(comm, [&] {
    config::Case given = config::load_case(command.case_file, command.overrides);
    if (command.output) given.output.directory = *command.output;
    return bytes_of(config::to_toml(given));
  });
  return config::parse_case(text_of(text), command.case_file);
}

Progress::Style progress_style(const MeshCommand& command, const comm::Communicator& comm)
{
  if (comm.rank() != 0 || command.verbosity == Verbosity::quiet) return Progress::Style::silent;
  const bool is_terminal =
      command.progress == pipeline::ProgressMode::always
      || (command.progress == pipeline::ProgressMode::automatic && isatty(STDOUT_FILENO) != 0);
  return is_terminal ? Progress::Style::bar : Progress::Style::lines;
}

// One run in its folder, which is locked as long as this lives.
class MeshRun {
 public:
  MeshRun(const MeshCommand& command, config::Case given, const comm::Communicator& comm,
          jobs::JobRunner& jobs)
      : command_(command), given_(std::move(given)), comm_(comm), jobs_(jobs)
  {
    all_or_none(comm, [&] {
      if (comm.rank() == 0) open_folder();
    });
    comm.barrier();
    jobs.set_log_file(jobs_log());
  }

  ExitCode run()
  {
    std::shared_ptr<spdlog::logger> log;
    all_or_none(comm_, [&] {
      const bool speaks = comm_.rank() == 0;
      log =
          make_log(speaks ? given_.output.directory / "log" / log_name() : "", command_.verbosity);
    });
    Progress progress(progress_style(command_, comm_), log);
    RunContext context{comm_, jobs_, progress, *log, given_.output.directory, jobs_log()};
    try {
      return command_.dry_run ? predict(context) : mesh(context);
    } catch (const comm::ThrownOnAllRanks& thrown) {
      progress.clear();
      if (comm_.rank() == 0) report_failure(thrown.error(), context);
      const ExitCode code = exit_code_of(thrown.error());
      if (code == ExitCode::stopped && !command_.dry_run) {
        throw_on_all_ranks(code, std::string(thrown.error().what()) + "; --resume goes on");
      }
      throw;
    }
  }

 private:
  [[nodiscard]] std::filesystem::path jobs_log() const
  {
    return given_.output.directory / "log" / fmt::format("rank_{:06}.log", comm_.rank());
  }

  void open_folder()
  {
    if (command_.resume) state().require_begun();
    netgen::require_model_file(given_.geometry.file);  // A mistyped name leaves no folder behind.
    folder_.emplace(given_.output.directory, existing());
    std::filesystem::remove_all(sample_folder(given_.output.directory));
    io::make_own_folder(given_.output.directory / "log");
    if (command_.dry_run) return;
    if (command_.resume) state().require_same_case(given_);
    io::make_own_folder(given_.output.directory / "mesh");
    io::make_own_folder(given_.output.directory / "boundary");
    io::write_text_atomically(given_.output.directory / "case.toml", config::to_toml(given_));
  }

  [[nodiscard]] RunState state() const
  {
    return {given_.output.directory, command_.only_subdomains};
  }

  // A dry run removes nothing that a run has left, and leaves nothing in the way of one.
  [[nodiscard]] io::ExistingFolder existing() const
  {
    if (command_.dry_run) return io::ExistingFolder::resume;
    if (command_.overwrite) return io::ExistingFolder::overwrite;
    return command_.resume ? io::ExistingFolder::resume : io::ExistingFolder::refuse;
  }

  // A run that has ended needs no more than a look at whether it is the same run.
  std::optional<ExitCode> finished(RunContext& context) const
  {
    if (!command_.resume) return std::nullopt;
    const RunState state = this->state();
    const auto code = find_on_root(comm_, [&]() -> std::optional<Bytes> {
      const auto ended = state.finished();
      if (!ended) return std::nullopt;
      ByteWriter out;
      out.put(*ended);
      return std::move(out).take();
    });
    if (!code) return std::nullopt;
    const model::ModelSource model = run_model_stage(given_, context);
    all_or_none(comm_, [&] {
      if (comm_.rank() != 0) return;
      state.require_same_run(hash_bytes(model.content));
      state.clear();
    });
    context.log.info("nothing to do: the run in {} has ended", given_.output.directory.string());
    return ByteReader(*code).get<ExitCode>();
  }

  ExitCode mesh(RunContext& context)
  {
    if (const auto code = finished(context)) return *code;
    const RunState state = this->state();
    const RunResult run = run_pipeline(given_, {&state, command_.only_subdomains}, context);
    const Verdict verdict = judge(run);
    RunFigures run_figures = figures();
    all_or_none(comm_, [&] {
      if (comm_.rank() != 0) return;
      run_figures.predicted = predicted(run, run_figures, context);
      io::write_text_atomically(given_.output.directory / "report.json",
                                report_json(run, verdict, run_figures, context.times));
      folder_->remove_half_written();  // Of jobs that were killed and done again.
      state.clear();
      // What a later try made good needs no diagnosis; a region that failed has had but one.
      if (verdict.exit_code == ExitCode::ok && run.filled.improvement.num_failed == 0) {
        std::error_code error;  // The mesh is whole and the report says so, whatever stays here.
        std::filesystem::remove_all(given_.output.directory / "failure", error);
        if (error) context.log.warn("failure: cannot be removed: {}", error.message());
      }
    });
    if (comm_.rank() == 0) {
      for (const std::string& reason : verdict.reasons) context.log.warn("degraded: {}", reason);
      if (const double balance = balance_of_parts(run); balance > kMostBalance) {
        context.log.warn(
            "the largest part has {:.3g} times the average of tets; more "
            "decompose.subdomains make smaller units to share out",
            balance);
      }
      context.log.info("{} tets in {} pieces, {:.1f} s: {}", run.filled.num_tets(),
                       run.filled.pieces.size(), run_figures.wall_time_s,
                       given_.output.directory.string());
    }
    return verdict.exit_code;
  }

  [[nodiscard]] const char* log_name() const
  {
    return command_.dry_run ? "dry_run.log" : "run.log";
  }

  ExitCode predict(RunContext& context)
  {
    const int num_ranks = command_.predicted_ranks.value_or(comm_.size());
    const std::string table =
        dry_run(given_, {nullptr, command_.only_subdomains}, num_ranks, context);
    if (comm_.rank() == 0 && command_.verbosity != Verbosity::quiet)
      std::fputs(table.c_str(), stdout);
    return ExitCode::ok;
  }

  // Held against the prediction of a dry run, if there was one of this run.
  [[nodiscard]] std::vector<PredictedFigure> predicted(const RunResult& run,
                                                       const RunFigures& run_figures,
                                                       const RunContext& context) const
  {
    GlobalIndex num_boundary = 0;
    for (const subdomain::PieceSummary& piece : run.filled.pieces)
      num_boundary += piece.num_boundary;
    const FolderSize size = size_of_folders(given_.output.directory, {"mesh", "boundary"});
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
    return compare_with_prediction(given_.output.directory,
                                   PredictedRun(given_, run.model, run.only_subdomains), actual);
  }

  // The report of a run that has ended stays: it is what a refused --resume is judged by.
  void report_failure(const std::exception& error, const RunContext& context) const
  {
    if (command_.dry_run || state().finished()) return;
    RunFigures failed = local_figures();
    failed.peak_rss_bytes_max = peak_rss_bytes();
    try {
      io::write_text_atomically(
          given_.output.directory / "report.json",
          failure_json(exit_code_of(error), error.what(), failed, context.times));
    } catch (const Error& second) {
      context.log.warn("report.json is missing: {}", second.what());
    }
  }

  [[nodiscard]] std::size_t peak_rss_bytes() const
  {
    return jobs::peak_rss_of_this_process() + jobs_.peak_rss_bytes();
  }

  [[nodiscard]] RunFigures local_figures() const
  {
    const auto now = std::chrono::steady_clock::now();
    return {.case_name = command_.case_file.filename().string(),
            .num_ranks = comm_.size(),
            .is_resumed = command_.resume,
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

  const MeshCommand& command_;
  config::Case given_;
  const comm::Communicator& comm_;
  jobs::JobRunner& jobs_;
  std::optional<io::OutputFolder> folder_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

ExitCode run_mesh_command(const MeshCommand& command, const comm::Communicator& comm,
                          jobs::JobRunner& jobs)
{
  config::Case given = read_case(command, comm);
  if (command.dump_config) {
    if (comm.rank() == 0) std::fputs(config::to_toml(given).c_str(), stdout);
    return ExitCode::ok;
  }
  if (!command.only_subdomains.empty()) require_only_subdomains_possible(given);
  return MeshRun(command, std::move(given), comm, jobs).run();
}

}  // namespace tessera::pipeline
