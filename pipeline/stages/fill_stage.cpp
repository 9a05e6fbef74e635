// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill_stage.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/work_queue.hpp"
#include "tessera/fill/ladder.hpp"

#include "pipeline/exit_code.hpp"
#include "pipeline/failed_jobs.hpp"
#include "pipeline/fill_record.hpp"
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

double weight_of(const SubdomainRange& range, const std::vector<double>& subdomain_weight)
{
  double weight = 0.0;
  for (LocalIndex s = range.first; s < range.last; ++s) weight += subdomain_weight[at(s)];
  return weight;
}

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
  limits.cpu_s = std::max(kLeastTime_s, kTimeMargin * predicted_tets / kSlowTetsPerSecond);
  if (options.timeout_s > 0.0) {
    limits.cpu_s = options.timeout_s;
    limits.stall_s = std::min(limits.stall_s, options.timeout_s);
  }
  return limits;
}

bool depends_on_machine(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::out_of_time
         || outcome.status == jobs::JobStatus::stalled
         || outcome.status == jobs::JobStatus::out_of_memory || was_killed_from_outside(outcome);
}

// Of a poor piece in the store nobody can tell whether the run was killed before its other try: it
// is made again, so that a resumed run has the bits of one that was never stopped.
bool is_poor(const std::vector<FillResult>& results)
{
  const PieceSummary& first = results.front().summary;
  return first.kernel == fill::KernelKind::netgen && first.tets.min_dihedral_deg < kPoorAngle_deg;
}

// Climbs the ladder for one range of subdomains after another; keeps what this rank's pieces sum up
// to.
class Filler {
 public:
  Filler(const fill::FillOptions& options, const FillWork& work, RunContext& context)
      : options_(options), work_(work), context_(context)
  {
    own_.seam_sums.resize(at(work.cut.skeleton.num_triangles()));
  }

  /// Fills one range. @throws MeshError if every rung failed, Interrupted if cancelled.
  void fill(const SubdomainRange& range, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const Hash128 plan =
        plan_fingerprint(work_.cut.skeleton, work_.damping, range.first, range.last);
    const auto record = find_record(context_.folder, range.number, plan);
    if (record && !is_poor(record->results)) return keep(record->results);
    Climb climb{.range = range, .plan = plan};
    for (const fill::FillTry& settings :
         fill::retry_ladder(options_, work_.kernels[at(range.first)])) {
      if (is_done_after(climb, settings, on_wait)) break;
    }
    if (climb.best.empty()) {
      std::string text = "subdomain " + std::to_string(range.first)
                         + " could not be filled; try another decompose.subdomains or a smaller "
                           "coarse.max_size";
      for (const std::string& failure : climb.failures) text += "\n  " + failure;
      throw MeshError(text);
    }
    keep(climb.best);
  }

  [[nodiscard]] FilledPieces take() && { return std::move(own_); }

 private:
  // What the rungs of one range's ladder have given so far.
  struct Climb {
    SubdomainRange range{};
    Hash128 plan{};
    LocalIndex tries = 0;
    bool was_limited = false;
    std::vector<FillResult> best{};
    std::vector<std::string> failures{};
  };

  // Takes one rung. A failure leads to the next one; a poor result of NETGEN, to one more try.
  bool is_done_after(Climb& climb, const fill::FillTry& settings,
                     const jobs::JobRunner::WaitCallback& on_wait)
  {
    const bool had_one = !climb.best.empty();
    const bool is_netgen = settings.kernel == fill::KernelKind::netgen;
    if (had_one && !is_netgen) return true;
    const double angle_to_beat = had_one ? climb.best.front().summary.tets.min_dihedral_deg : 0.0;
    ++climb.tries;
    const jobs::JobOutcome outcome =
        run_try(climb.range, request_of(climb, settings, angle_to_beat), on_wait);
    throw_unless_of_the_fill(outcome);
    climb.was_limited = climb.was_limited || depends_on_machine(outcome);
    if (outcome.status != jobs::JobStatus::ok) {
      if (!had_one) keep_failure(climb, settings, outcome, on_wait);
      climb.failures.push_back("try " + std::to_string(climb.tries) + " ("
                               + std::string(fill::name_of(settings.kernel))
                               + "): " + outcome.message);
      return had_one;
    }
    climb.best = fill_results_from_bytes(outcome.result);
    context_.log.debug("fill: subdomain {}: try {}, {:.2f} s of CPU time", climb.range.first,
                       climb.tries, outcome.cpu_s);
    return had_one || !is_poor(climb.best);
  }

  // As a job that measures only: its replay must not touch the run's folder.
  void keep_failure(const Climb& climb, const fill::FillTry& settings,
                    const jobs::JobOutcome& outcome, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const Bytes request = request_of(climb, settings, 0.0, false);
    const jobs::JobLimits limits;
    const JobRequest job{name_of(climb.range), request, limits};
    keep_meshes_of_failed_fill(keep_failed_job(job, request, outcome, context_), climb.range.first,
                               work_.cut.coarse, work_.cut.decomposition, on_wait, context_);
  }

  static std::string name_of(const SubdomainRange& range)
  {
    return "fill: subdomain " + std::to_string(range.first);
  }

  // The job itself puts into the record how it came to be made: a resumed run has only that.
  static Bytes request_of(const Climb& climb, const fill::FillTry& settings, double angle_to_beat,
                          bool keep = true)
  {
    return fill_request({.batch = climb.range.number,
                         .first = climb.range.first,
                         .last = climb.range.last,
                         .plan = climb.plan,
                         .settings = settings,
                         .angle_to_beat_deg = angle_to_beat,
                         .tries = climb.tries,
                         .was_limited = climb.was_limited,
                         .keep = keep,
                         .failures = climb.failures});
  }

  jobs::JobOutcome run_try(const SubdomainRange& range, const Bytes& request,
                           const jobs::JobRunner::WaitCallback& on_wait)
  {
    const jobs::JobLimits limits =
        limits_of(options_, weight_of(range, work_.cut.decomposition.subdomain_weight));
    return run_job({name_of(range), request, limits}, on_wait, context_);
  }

  // A stop, a full disk and a lost worker end the run; no other rung helps there.
  static void throw_unless_of_the_fill(const jobs::JobOutcome& outcome)
  {
    throw_if_cancelled(outcome);
    if (outcome.error == jobs::ErrorKind::output) throw OutputError(outcome.message);
    if (outcome.error == jobs::ErrorKind::config) throw ConfigError(outcome.message);
    if (outcome.loads_are_lost) throw MeshError(outcome.message + "; go on with --resume");
  }

  void keep(const std::vector<FillResult>& results)
  {
    for (const FillResult& result : results) {
      if (result.summary.is_folded) {
        own_.folded.push_back({result.summary.subdomain, result.summary.was_limited});
        continue;
      }
      own_.pieces.push_back(result.summary);
      if (!result.failures.empty()) {
        own_.failures.push_back({result.summary.subdomain, result.failures});
      }
      own_.histograms.add(result.histograms);
      for (const verify::SeamHash& seam : result.seams) {
        own_.seam_sums[at(seam.triangle)] += seam.hash;
      }
    }
  }

  const fill::FillOptions& options_;
  const FillWork& work_;
  RunContext& context_;
  FilledPieces own_{};
};

void sum_over_ranks(quality::Histogram& histogram, const comm::Communicator& comm)
{
  std::vector<GlobalIndex> counts = histogram.counts();
  comm.sum_in_place(counts);
  histogram.set_counts(std::move(counts));
}

// What all ranks have in their lists, one list behind the other.
template <class T>
std::vector<T> gather(const std::vector<T>& own, const comm::Communicator& comm)
{
  std::vector<T> all;
  for (const Bytes& bytes : comm.all_gather(std::as_bytes(std::span(own)))) {
    const std::size_t first = all.size();
    all.resize(first + bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(&all[first], bytes.data(), bytes.size());
  }
  return all;
}

std::vector<FailedTries> gather(const std::vector<FailedTries>& own, const comm::Communicator& comm)
{
  ByteWriter out;
  out.put(static_cast<std::uint64_t>(own.size()));
  for (const FailedTries& failed : own) {
    out.put(failed.subdomain);
    out.put(failed.messages);
  }
  std::vector<FailedTries> all;
  for (const Bytes& bytes : comm.all_gather(std::move(out).take())) {
    ByteReader in(bytes);
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
      const auto subdomain = in.get<LocalIndex>();
      all.push_back({subdomain, in.get_strings()});
    }
  }
  return all;
}

// Puts what the ranks have together; integers and sums modulo 2^64 only, so in any order the same.
FilledPieces combine(FilledPieces own, const comm::Communicator& comm)
{
  FilledPieces all;
  all.pieces = gather(own.pieces, comm);
  all.folded = gather(own.folded, comm);
  all.failures = gather(own.failures, comm);
  std::ranges::sort(all.folded, {}, &FoldedSubdomain::subdomain);
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

FilledPieces run_fill_stage(const config::Case& run_case, const FillWork& work, RunContext& context)
{
  const auto num_ranges = static_cast<LocalIndex>(work.ranges.size());
  const bool is_one_each = num_ranges == work.cut.num_subdomains();
  StageScope stage(context, "fill", num_ranges, is_one_each ? "subdomains" : "files");
  Filler filler(run_case.fill, work, context);
  std::exception_ptr defect;
  std::vector<double> weights;
  for (const SubdomainRange& range : work.ranges) {
    weights.push_back(weight_of(range, work.cut.decomposition.subdomain_weight));
  }
  comm::WorkQueue queue(context.comm, job_order(weights));
  const auto on_wait = [&] {
    if (stop_requested()) queue.request_stop();
    context.progress.update(queue.num_handed_out());
    return queue.progress();
  };
  while (const auto range = queue.next()) {
    try {
      filler.fill(work.ranges[at(*range)], on_wait);
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
