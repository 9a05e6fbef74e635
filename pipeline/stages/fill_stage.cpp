// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill_stage.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/fill/fallbacks.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

// A piece with a smaller angle gets one more try, with the points in another order, and the better
// of the two stays. Most pieces reach 10 to 20 degrees; the last few of many reach 2 to 8.
constexpr double kPoorAngle_deg = 8.0;

double weight_of(const subdomain::SubdomainRange& range,
                 const std::vector<double>& subdomain_weight)
{
  double weight = 0.0;
  for (LocalIndex s = range.first; s < range.last; ++s) weight += subdomain_weight[at(s)];
  return weight;
}

// A piece with a small angle gets a second try. If such a piece is in the store, the run may have
// been killed before that try. So it is made again, and a resumed run has the bits of one that was
// never stopped.
bool is_poor(const std::vector<subdomain::FillResult>& results)
{
  const subdomain::PieceSummary& first = results.front().summary;
  return first.kernel == fill::KernelKind::netgen && first.tets.min_dihedral_deg < kPoorAngle_deg;
}

// Fills one range of subdomains after another, each by its sequence of fallbacks; keeps what this
// rank's pieces sum up to.
class Filler {
 public:
  Filler(const fill::FillOptions& options, const FillWork& work, RunContext& context)
      : options_(options),
        work_(work),
        context_(context),
        cut_fingerprint_(cut_fingerprint(work.cut))
  {
    own_.seam_sums.resize(at(work.cut.skeleton.num_triangles()));
  }

  /// Fills one range. @throws MeshError if every try failed, Interrupted if cancelled.
  void fill(const subdomain::SubdomainRange& range, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const Hash128 plan = plan_fingerprint(cut_fingerprint_, work_.cut.skeleton, work_.limiter,
                                          range.first, range.last);
    const auto record = find_record(context_.folder, record_name(range.number), plan);
    if (record && !is_poor(record->results)) return keep(record->results);
    Tries tries{.range = range, .plan = plan};
    for (const fill::FillTry& how :
         fill::fallback_sequence(options_, work_.kernels[at(range.first)])) {
      if (is_done_after(tries, how, on_wait)) break;
    }
    if (tries.best.empty()) {
      std::string text = fmt::format(
          "subdomain {} could not be filled; try another decompose.subdomains or a smaller "
          "coarse.max_size",
          range.first);
      if (tries.was_limited) text += ", or a larger fill.memory_gib or fill.timeout_s";
      for (const std::string& failure : tries.failures) text += "\n  " + failure;
      throw MeshError(text);
    }
    for (subdomain::FillResult& result : tries.best) {  // A try after it may have failed.
      result.summary.was_limited = tries.was_limited;
      result.summary.tries = tries.count;
      result.failures = tries.failures;
    }
    keep(tries.best);
  }

  [[nodiscard]] FilledPieces take() && { return std::move(own_); }

 private:
  // What the tries at one range have given so far.
  struct Tries {
    subdomain::SubdomainRange range{};
    Hash128 plan{};
    LocalIndex count = 0;
    bool was_limited = false;
    std::vector<subdomain::FillResult> best{};
    std::vector<std::string> failures{};
  };

  // One try. A failure leads to the next one; a poor result of NETGEN, to one more try.
  bool is_done_after(Tries& tries, const fill::FillTry& how,
                     const jobs::JobRunner::WaitCallback& on_wait)
  {
    const bool had_one = !tries.best.empty();
    const bool is_netgen = how.kernel == fill::KernelKind::netgen;
    if (had_one && !is_netgen) return true;
    const double angle_to_beat =
        had_one ? tries.best.front().summary.tets.min_dihedral_deg : kAnyAngle;
    ++tries.count;
    jobs::JobOutcome outcome = run_try(tries.range, request_of(tries, how, angle_to_beat), on_wait);
    auto made = read_result(outcome, from_bytes<std::vector<subdomain::FillResult>>);
    throw_unless_of_the_job(outcome);
    tries.was_limited = tries.was_limited || depends_on_machine(outcome);
    if (!made) {
      if (!had_one) keep_failure(tries, how, outcome, on_wait);
      tries.failures.push_back(
          fmt::format("try {} ({}): {}", tries.count, word_of(how.kernel), outcome.message));
      return had_one;
    }
    tries.best = std::move(*made);
    context_.log.debug("fill: subdomain {}: try {}, {:.2f} s of CPU time", tries.range.first,
                       tries.count, outcome.cpu_s);
    return had_one || !is_poor(tries.best);
  }

  // As a job that measures only: its replay must not touch the run's folder.
  void keep_failure(const Tries& tries, const fill::FillTry& how, const jobs::JobOutcome& outcome,
                    const jobs::JobRunner::WaitCallback& on_wait)
  {
    const Bytes request = request_of(tries, how, kAnyAngle, false);
    const jobs::JobLimits limits;
    const JobRequest job{name_of(tries.range), request, limits};
    keep_meshes_of_failed_fill(keep_failed_job(job, request, outcome, context_), tries.range.first,
                               work_.cut.coarse, work_.cut.decomposition, on_wait, context_);
  }

  static std::string name_of(const subdomain::SubdomainRange& range)
  {
    return fmt::format("fill: subdomain {}", range.first);
  }

  // The job itself puts into the record how it came to be made: a resumed run has only that.
  static Bytes request_of(const Tries& tries, const fill::FillTry& how, double angle_to_beat,
                          bool keep = true)
  {
    return fill_request({.batch = tries.range.number,
                         .first = tries.range.first,
                         .last = tries.range.last,
                         .plan = tries.plan,
                         .how = how,
                         .angle_to_beat_deg = angle_to_beat,
                         .tries = tries.count,
                         .was_limited = tries.was_limited,
                         .keep = keep,
                         .failures = tries.failures});
  }

  jobs::JobOutcome run_try(const subdomain::SubdomainRange& range, const Bytes& request,
                           const jobs::JobRunner::WaitCallback& on_wait)
  {
    const jobs::JobLimits limits =
        job_limits(options_, weight_of(range, work_.cut.decomposition.subdomain_weight));
    return run_job({name_of(range), request, limits}, on_wait, context_);
  }

  void keep(const std::vector<subdomain::FillResult>& results)
  {
    for (const subdomain::FillResult& result : results) own_.add(result);
  }

  const fill::FillOptions& options_;
  const FillWork& work_;
  RunContext& context_;
  Hash128 cut_fingerprint_;
  FilledPieces own_{};
};

}  // namespace

FilledPieces run_fill_stage(const config::Case& run_case, const FillWork& work, RunContext& context)
{
  const auto num_ranges = static_cast<LocalIndex>(work.ranges.size());
  const bool is_one_each = num_ranges == work.cut.num_subdomains();
  StageScope stage(context, "fill", num_ranges, is_one_each ? "subdomains" : "files");
  Filler filler(run_case.fill, work, context);
  std::vector<double> weights;
  for (const subdomain::SubdomainRange& range : work.ranges) {
    weights.push_back(weight_of(range, work.cut.decomposition.subdomain_weight));
  }
  for_each_dynamic(
      heaviest_first(weights),
      [&](LocalIndex range, const auto& on_wait) { filler.fill(work.ranges[at(range)], on_wait); },
      stage, context);

  FilledPieces all = combine(std::move(filler).take(), context.comm);
  stage.finish(fmt::format("{} tets", all.num_tets()));
  return all;
}

}  // namespace tessera::pipeline
