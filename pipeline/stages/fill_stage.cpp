// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill_stage.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/work_queue.hpp"
#include "tessera/fill/ladder.hpp"

#include "pipeline/exit_code.hpp"
#include "pipeline/mesh_worker.hpp"
#include "pipeline/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

// The slowest fills measured make 7 k tets/s; 20 times the time that takes is a hang.
constexpr double kSlowTetsPerSecond = 7000.0;
constexpr double kTimeMargin = 20.0;
constexpr double kLeastTime_s = 60.0;

// A piece with a smaller angle gets one more try, with the points in another order, and the better
// of the two stays. Most pieces reach 10 to 20 degrees; the last few of many reach 2 to 8.
constexpr double kPoorAngle_deg = 8.0;

std::vector<LocalIndex> largest_first(const std::vector<double>& weight)
{
  std::vector<LocalIndex> order(weight.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](LocalIndex a, LocalIndex b) { return weight[at(a)] > weight[at(b)]; });
  return order;
}

// The order in which jobs are handed out. TESSERA_TEST_FILL_ORDER=reverse turns it round: the tests
// show with it that no bit of the mesh depends on the order. No option, for no user needs it.
std::vector<LocalIndex> job_order(const std::vector<double>& weight)
{
  std::vector<LocalIndex> order = largest_first(weight);
  const char* asked = std::getenv("TESSERA_TEST_FILL_ORDER");
  if (asked != nullptr && std::string_view(asked) == "reverse") {
    std::reverse(order.begin(), order.end());
  }
  return order;
}

jobs::JobLimits limits_of(const fill::FillOptions& options, double predicted_tets)
{
  jobs::JobLimits limits;
  limits.memory_gib = options.memory_gib;
  limits.cpu_s = options.timeout_s > 0.0
                     ? options.timeout_s
                     : std::max(kLeastTime_s, kTimeMargin * predicted_tets / kSlowTetsPerSecond);
  return limits;
}

// By hand, or by a system that is short of memory: it says nothing about the skin.
bool was_killed_from_outside(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::crashed && outcome.code == SIGKILL;
}

bool depends_on_machine(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::out_of_time
         || outcome.status == jobs::JobStatus::stalled
         || outcome.status == jobs::JobStatus::out_of_memory || was_killed_from_outside(outcome);
}

// Climbs the ladder for one subdomain after another; keeps what this rank's pieces sum up to.
class Filler {
 public:
  Filler(const fill::FillOptions& options, const mesh::Decomposition& decomposition,
         const mesh::Skeleton& skeleton, RunContext& context)
      : options_(options), decomposition_(decomposition), context_(context)
  {
    own_.seam_sums.resize(at(skeleton.num_triangles()));
  }

  /// Fills one subdomain. @throws MeshError if every rung failed, Interrupted if cancelled.
  void fill(LocalIndex subdomain, const jobs::JobRunner::WaitCallback& on_wait)
  {
    Climb climb{.subdomain = subdomain};
    for (const fill::FillTry& settings : fill::retry_ladder(options_)) {
      if (is_done_after(climb, settings, on_wait)) break;
    }
    if (!climb.best) {
      throw MeshError("subdomain " + std::to_string(subdomain)
                      + " could not be filled; try another decompose.subdomains or a smaller "
                        "coarse.max_size"
                      + climb.failures);
    }
    climb.best->summary.was_limited = climb.was_limited;
    keep(*climb.best);
  }

  [[nodiscard]] FilledPieces take() && { return std::move(own_); }

 private:
  // What the rungs of one subdomain's ladder have given so far.
  struct Climb {
    LocalIndex subdomain = kNoIndex;
    LocalIndex tries = 0;
    bool was_limited = false;
    std::optional<FillResult> best{};
    std::string failures{};
  };

  // Takes one rung. A failure leads to the next one; a poor result, to one more try.
  bool is_done_after(Climb& climb, const fill::FillTry& settings,
                     const jobs::JobRunner::WaitCallback& on_wait)
  {
    const bool had_one = climb.best.has_value();
    const double angle_to_beat = had_one ? climb.best->summary.tets.min_dihedral_deg : 0.0;
    const jobs::JobOutcome outcome =
        run_try(climb.subdomain, fill_request(climb.subdomain, settings, angle_to_beat), on_wait);
    ++climb.tries;
    throw_unless_of_the_fill(outcome);
    climb.was_limited = climb.was_limited || depends_on_machine(outcome);
    if (outcome.status != jobs::JobStatus::ok) {
      climb.failures += "\n  try " + std::to_string(climb.tries) + ": " + outcome.message;
      return had_one;
    }
    climb.best = fill_result_from_bytes(outcome.result);
    PieceSummary& summary = climb.best->summary;
    summary.tries = climb.tries;
    summary.cpu_s = outcome.cpu_s;
    context_.log.debug("fill: subdomain {}: {} tets, try {}, {:.2f} s of CPU time", climb.subdomain,
                       summary.num_tets, summary.tries, summary.cpu_s);
    return had_one || summary.tets.min_dihedral_deg >= kPoorAngle_deg;
  }

  // The same once more if the job was killed, so that the mesh is the same as without that.
  jobs::JobOutcome run_try(LocalIndex subdomain, const Bytes& request,
                           const jobs::JobRunner::WaitCallback& on_wait)
  {
    const jobs::JobLimits limits =
        limits_of(options_, decomposition_.subdomain_weight[at(subdomain)]);
    jobs::JobOutcome outcome = context_.jobs.run(request, limits, on_wait);
    if (!was_killed_from_outside(outcome) || outcome.loads_are_lost) return outcome;
    context_.progress.clear();
    context_.log.warn("fill: subdomain {} is filled again: {}", subdomain, outcome.message);
    return context_.jobs.run(request, limits, on_wait);
  }

  // A stop, a full disk and a lost worker end the run; no other rung helps there.
  static void throw_unless_of_the_fill(const jobs::JobOutcome& outcome)
  {
    throw_if_cancelled(outcome);
    if (outcome.error == jobs::ErrorKind::output) throw OutputError(outcome.message);
    if (outcome.loads_are_lost) throw MeshError(outcome.message + "; run the case again");
  }

  void keep(const FillResult& result)
  {
    own_.pieces.push_back(result.summary);
    own_.histograms.add(result.histograms);
    for (const verify::SeamHash& seam : result.seams) {
      own_.seam_sums[at(seam.triangle)] += seam.hash;
    }
  }

  const fill::FillOptions& options_;
  const mesh::Decomposition& decomposition_;
  RunContext& context_;
  FilledPieces own_{};
};

void sum_over_ranks(quality::Histogram& histogram, const comm::Communicator& comm)
{
  std::vector<GlobalIndex> counts = histogram.counts();
  comm.sum_in_place(counts);
  histogram.set_counts(std::move(counts));
}

// Puts what the ranks have together; integers and sums modulo 2^64 only, so in any order the same.
FilledPieces combine(FilledPieces own, const comm::Communicator& comm)
{
  FilledPieces all;
  for (const Bytes& bytes : comm.all_gather(std::as_bytes(std::span(own.pieces)))) {
    const std::size_t first = all.pieces.size();
    all.pieces.resize(first + bytes.size() / sizeof(PieceSummary));
    if (!bytes.empty()) std::memcpy(&all.pieces[first], bytes.data(), bytes.size());
  }
  std::sort(all.pieces.begin(), all.pieces.end(),
            [](const PieceSummary& a, const PieceSummary& b) { return a.subdomain < b.subdomain; });
  all.histograms = std::move(own.histograms);
  sum_over_ranks(all.histograms.mean_ratio, comm);
  sum_over_ranks(all.histograms.seam_mean_ratio, comm);
  sum_over_ranks(all.histograms.log2_edge_length, comm);

  std::vector<std::uint64_t> halves;
  for (const Hash128& hash : own.seam_sums) halves.insert(halves.end(), {hash.low, hash.high});
  comm.sum_in_place(halves);
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    all.seam_sums.push_back({halves[i], halves[i + 1]});
  }
  return all;
}

}  // namespace

FilledPieces run_fill_stage(const config::Case& run_case, const mesh::Decomposition& decomposition,
                            const mesh::Skeleton& skeleton, RunContext& context)
{
  StageScope stage(context, "fill", decomposition.num_subdomains(), "subdomains");
  Filler filler(run_case.fill, decomposition, skeleton, context);
  std::exception_ptr defect;
  comm::WorkQueue queue(context.comm, job_order(decomposition.subdomain_weight));
  const auto on_wait = [&] {
    if (stop_requested()) queue.request_stop();
    context.progress.update(queue.num_handed_out());
    return queue.progress();
  };
  while (const auto subdomain = queue.next()) {
    try {
      filler.fill(*subdomain, on_wait);
    } catch (const Interrupted&) {
      queue.request_stop();
    } catch (const Error&) {
      defect = std::current_exception();
      queue.request_stop();
    }
  }
  stage.work_is_done();
  static_cast<void>(queue.finish());
  throw_if_stopped(context.comm);
  all_or_none(context.comm, [&] {
    if (defect) std::rethrow_exception(defect);
  });

  FilledPieces all = combine(std::move(filler).take(), context.comm);
  GlobalIndex num_tets = 0;
  for (const PieceSummary& piece : all.pieces) num_tets += piece.num_tets;
  stage.finish(std::to_string(num_tets) + " tets");
  return all;
}

}  // namespace tessera::pipeline
