// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/fill_stage.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/fill/fallbacks.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/stages/fill/fill_queue.hpp"
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

// Corners are split as the case's kernel wants it, also where folds have put another in its place.
std::vector<fill::FillTry> tries_of(const fill::FillOptions& options, const FillWork& work,
                                    const subdomain::SubdomainRange& range)
{
  fill::FillOptions of_range = options;
  of_range.split_corners = fill::splits_corners(options, work.wanted[at(range.first)]);
  return fill::fallback_sequence(of_range, work.kernels[at(range.first)]);
}

std::vector<std::vector<fill::KernelKind>> kernels_of_tries(const fill::FillOptions& options,
                                                            const FillWork& work)
{
  std::vector<std::vector<fill::KernelKind>> kernels;
  for (const subdomain::SubdomainRange& range : work.ranges) {
    kernels.emplace_back();
    for (const fill::FillTry& how : tries_of(options, work, range)) {
      kernels.back().push_back(how.kernel);
    }
  }
  return kernels;
}

[[noreturn]] void throw_not_filled(LocalIndex subdomain, const FillTries& tries)
{
  std::string text = fmt::format(
      "subdomain {} could not be filled; try another decompose.subdomains or a smaller "
      "coarse.max_size",
      subdomain);
  if (tries.was_limited) text += ", or a larger fill.memory_gib or fill.timeout_s";
  for (const std::string& failure : tries.failures) text += "\n  " + failure;
  throw MeshError(text);
}

// Makes single tries; keeps what this rank's pieces sum up to.
class Filler {
 public:
  Filler(const fill::FillOptions& options, const FillWork& work, RunContext& context)
      : options_(options),
        work_(work),
        context_(context),
        cut_fingerprint_(comm::on_root(context.comm, [&] { return cut_fingerprint(work.cut); }))
  {
  }

  /// One try. @throws Interrupted if cancelled, and for what another try cannot mend.
  FillVerdict attempt(const FillOrder& order, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const subdomain::SubdomainRange& range = work_.ranges[at(order.range)];
    const Hash128 plan = plan_fingerprint(cut_fingerprint_, work_.cut.skeleton, work_.limiter,
                                          range.first, range.last);
    if (order.number == 0) {
      auto record = find_record(context_.folder, record_name(range.number), plan);
      if (record && !is_poor(record->results)) {
        made_[order.range] = {std::move(record->results), true};
        return {};
      }
    }
    auto [made, end, cpu_s] = run_try(range, request_of(order, plan, !order.is_probe), on_wait);
    throw_unless_of_the_job(end);
    context_.log.debug(fmt::format("fill: subdomain {}: try {}{}, {:.2f} s of CPU time",
                                   range.first, order.number + 1,
                                   order.is_probe ? " before its turn" : "", cpu_s));
    if (!made) {
      if (!order.before.is_made) keep_failure(order, plan, end, on_wait);
      return {.end = std::move(end)};
    }
    const FillVerdict verdict{.is_poor = is_poor(*made),
                              .angle_deg = made->front().summary.tets.min_dihedral_deg};
    if (!order.is_probe) made_[order.range] = {std::move(*made), false};
    return verdict;
  }

  /// What this rank has of the pieces that count. @param tries Of all ranges, as they ended.
  [[nodiscard]] FilledPieces take(const std::vector<FillTries>& tries) &&
  {
    FilledPieces own;
    own.seam_sums.resize(at(work_.cut.skeleton.num_triangles()));
    for (auto& [range, made] : made_) {
      const FillTries& ended = tries[at(range)];
      if (ended.holder != context_.comm.rank()) continue;
      for (subdomain::FillResult& result : made.results) {
        if (!made.is_of_record) {  // A try after it may have failed.
          result.summary.was_limited = ended.was_limited;
          result.summary.tries = ended.count;
          result.failures = ended.failures;
        }
        own.add(result);
      }
    }
    return own;
  }

 private:
  struct Made {
    std::vector<subdomain::FillResult> results{};
    bool is_of_record = false;  // An earlier run has made it, and its record says how.
  };

  // As a job that measures only: its replay must not touch the run's folder.
  void keep_failure(const FillOrder& order, const Hash128& plan, const jobs::JobEnd& end,
                    const jobs::JobRunner::WaitCallback& on_wait)
  {
    const subdomain::SubdomainRange& range = work_.ranges[at(order.range)];
    FillOrder anew = order;
    anew.before.angle_to_beat_deg = kAnyAngle;
    const Bytes request = request_of(anew, plan, false);
    const jobs::JobLimits limits;
    const JobRequest job{name_of(range), request, limits};
    keep_meshes_of_failed_fill(keep_failed_job(job, request, end, context_), range.first,
                               work_.cut.coarse, work_.cut.decomposition, on_wait, context_);
  }

  static std::string name_of(const subdomain::SubdomainRange& range)
  {
    return fmt::format("fill: subdomain {}", range.first);
  }

  // The job itself puts into the record how it came to be made: a resumed run has only that.
  [[nodiscard]] Bytes request_of(const FillOrder& order, const Hash128& plan, bool keep) const
  {
    const subdomain::SubdomainRange& range = work_.ranges[at(order.range)];
    return fill_request({.batch = range.number,
                         .first = range.first,
                         .last = range.last,
                         .plan = plan,
                         .how = tries_of(options_, work_, range).at(at(order.number)),
                         .angle_to_beat_deg = order.before.angle_to_beat_deg,
                         .tries = order.before.count + 1,
                         .was_limited = order.before.was_limited,
                         .keep = keep,
                         .failures = order.before.failures});
  }

  JobResult<std::vector<subdomain::FillResult>> run_try(
      const subdomain::SubdomainRange& range, const Bytes& request,
      const jobs::JobRunner::WaitCallback& on_wait)
  {
    const jobs::JobLimits limits =
        job_limits(options_, weight_of(range, work_.cut.decomposition.subdomain_weight));
    return attempt_job({name_of(range), request, limits},
                       from_bytes<std::vector<subdomain::FillResult>>, on_wait, context_);
  }

  const fill::FillOptions& options_;
  const FillWork& work_;
  RunContext& context_;
  Hash128 cut_fingerprint_;
  std::map<LocalIndex, Made> made_{};  // By range.
};

}  // namespace

FilledPieces run_fill_stage(const config::Case& run_case, const FillWork& work, RunContext& context)
{
  const auto num_ranges = static_cast<LocalIndex>(work.ranges.size());
  const bool is_one_each = num_ranges == work.cut.num_subdomains();
  StageScope stage(context, Stage::fill, num_ranges, is_one_each ? "subdomains" : "files");
  Filler filler(run_case.fill, work, context);
  std::vector<double> weights;
  for (const subdomain::SubdomainRange& range : work.ranges) {
    weights.push_back(weight_of(range, work.cut.decomposition.subdomain_weight));
  }
  FillQueue queue(heaviest_first(weights), kernels_of_tries(run_case.fill, work), seconds_now);
  run_tasks(
      queue,
      [&](const comm::Task& task, const auto& on_wait) {
        const auto look = [&] {
          context.progress.update(queue.num_begun());
          return on_wait();
        };
        return to_bytes(filler.attempt(from_bytes<FillOrder>(task.more), look));
      },
      stage, context);
  const auto tries = on_root(context.comm, [&] {
    if (const auto range = queue.hopeless()) {
      throw_not_filled(work.ranges[at(*range)].first, queue.tries()[at(*range)]);
    }
    return queue.tries();
  });
  FilledPieces all = combine(std::move(filler).take(tries), context.comm);
  stage.finish(fmt::format("{} tets", all.num_tets()));
  return all;
}

}  // namespace tessera::pipeline
