// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/refine_stage.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/orbits.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/subdomain/layer_tables.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/piece_surfaces.hpp"

namespace tessera::pipeline {
namespace {

// All that the refined pieces are made from, but for the limiter.
struct RefineOrigin {
  Hash128 cut{};
  std::vector<fill::KernelKind> kernels{};
  subdomain::PieceSplit split{};
  std::vector<subdomain::PieceSummary> pieces{};

  static auto fields(auto& self)
  {
    return std::tie(self.cut, self.kernels, self.split, self.pieces);
  }
};

Hash128 origin_of(const RefineWork& work, const FilledPieces& filled)
{
  RefineOrigin origin{cut_fingerprint(work.cut), work.kernels, work.split, filled.pieces};
  for (subdomain::PieceSummary& piece : origin.pieces) piece.cpu_s = 0.0;  // As it happened to be.
  return hash_bytes(to_bytes(origin));
}

struct CountedPiece {
  LocalIndex subdomain = kNoIndex;
  number::PieceCounts counts{};

  static auto fields(auto& self) { return std::tie(self.subdomain, self.counts); }
};

class StageWork {
 public:
  StageWork(const config::Case& run_case, const RefineWork& work, const FilledPieces& filled,
            RunContext& context, StageScope& stage)
      : run_case_(run_case),
        work_(work),
        filled_(filled),
        context_(context),
        stage_(stage),
        pieces_(store_of(filled, context.folder)),
        layers_(subdomain::layer_tables(work.cut, work.split.levels)),
        surfaces_(pieces_, work.cut, layers_ ? &*layers_ : nullptr),
        neighbours_(mesh::neighbours_by_vertex(work.cut.skeleton)),
        origin_(comm::on_root(context.comm, [&] { return origin_of(work, filled); }))
  {
  }

  // What every piece will hold, and with it all ids.
  [[nodiscard]] std::vector<number::PieceCounts> count_pieces()
  {
    for_each_piece([&](LocalIndex s) { surfaces_.keep_list(s); });
    std::vector<CountedPiece> own;
    for_each_piece([&](LocalIndex s) { own.push_back({s, surfaces_.compare(s, work_.split)}); });
    std::vector<number::PieceCounts> counts(filled_.pieces.size());
    for (const CountedPiece& piece : context_.comm.all_gather_rows(own)) {
      counts[at(piece.subdomain)] = piece.counts;
    }
    return counts;
  }

  // Makes the pieces that are not in the store. @return Those of all ranks, and new limits.
  [[nodiscard]] std::pair<FilledPieces, std::vector<mesh::PointLimit>> refine_all(
      const mesh::ProjectionLimiter& limiter)
  {
    own_ = {};
    own_.seam_sums.resize(at(work_.cut.skeleton.num_triangles()));
    folds_.clear();
    for_each_dynamic(
        heaviest_first(weights()),
        [&](LocalIndex row, const auto& on_wait) {
          refine(work_.ranges[at(row)], limiter, on_wait);
        },
        stage_, context_, num_done_);
    return {combine(std::move(own_), context_.comm), context_.comm.all_gather_rows(folds_)};
  }

 private:
  void for_each_piece(const std::function<void(LocalIndex)>& make)
  {
    for_each_dynamic(in_order(filled_.pieces.size()), in_thread(make), stage_, context_, num_done_);
    num_done_ += std::ssize(filled_.pieces);
  }

  // Of one material all pieces are smoothed or none: on seams both sides must do the same.
  [[nodiscard]] PieceToRefine piece_to_refine(LocalIndex s) const
  {
    PieceToRefine one{stored_piece(pieces_, s), surfaces_.surroundings(s, work_.split),
                      filled_.pieces[at(s)]};
    one.around.is_smoothed = work_.kernels[at(s)] != fill::KernelKind::subdivide;
    return one;
  }

  [[nodiscard]] double num_tets_of(const subdomain::SubdomainRange& range) const
  {
    GlobalIndex num_tets = 0;
    for (LocalIndex s = range.first; s < range.last; ++s)
      num_tets += filled_.pieces[at(s)].num_tets;
    num_tets <<= 3 * work_.split.levels;
    for (LocalIndex s = range.first; layers_ && s < range.last; ++s)
      num_tets += layers_->counts(s).tets;
    return static_cast<double>(num_tets);
  }

  [[nodiscard]] std::vector<double> weights() const
  {
    std::vector<double> weights;
    for (const subdomain::SubdomainRange& range : work_.ranges) {
      weights.push_back(num_tets_of(range));
    }
    return weights;
  }

  // What of the limiter bears on pieces, and on their neighbours' tets beside them.
  [[nodiscard]] Hash128 fingerprint(const subdomain::SubdomainRange& range,
                                    const mesh::ProjectionLimiter& limiter) const
  {
    std::set<LocalIndex> subdomains;
    for (LocalIndex s = range.first; s < range.last; ++s) {
      subdomains.insert(s);
      subdomains.insert(neighbours_[at(s)].begin(), neighbours_[at(s)].end());
    }
    std::vector<Hash128> parts;
    for (const LocalIndex s : subdomains) {
      parts.push_back(plan_fingerprint(origin_, work_.cut.skeleton, limiter, s, s + 1));
    }
    const auto is_unlimited = [&](const Hash128& part) { return part == origin_; };
    return std::ranges::all_of(parts, is_unlimited) ? origin_ : hash_bytes(to_bytes(parts));
  }

  void refine(const subdomain::SubdomainRange& range, const mesh::ProjectionLimiter& limiter,
              const jobs::JobRunner::WaitCallback& on_wait)
  {
    RefineTask task{.batch = range.number, .plan = fingerprint(range, limiter)};
    if (const auto record = find_record(context_.folder, refined_name(range.number), task.plan)) {
      return keep({.results = record->results, .folds = {}});
    }
    for (LocalIndex s = range.first; s < range.last; ++s) task.pieces.push_back(piece_to_refine(s));
    const std::string name = fmt::format("refine: subdomain {}", range.first);
    const Bytes request = refine_request(task);
    const JobRequest job{name, request, job_limits(run_case_.fill, num_tets_of(range))};
    const auto [made, end, cpu_s] =
        attempt_job(job, from_bytes<RefineTaskResult>, on_wait, context_);
    throw_unless_of_the_job(end);
    if (made) return keep(*made);
    task.keep = false;  // A replay must not touch the run's folder.
    static_cast<void>(keep_failed_job(job, refine_request(task), end, context_));
    throw MeshError(
        fmt::format("subdomain {} could not be {}: {}; try another decompose.subdomains, {}{}",
                    range.first, work_.split.is_curved ? "curved" : "split further", end.message,
                    work_.split.is_curved ? "output.order = 1" : "a larger fill.levels",
                    depends_on_machine(end) ? ", a larger fill.memory_gib or fill.timeout_s" : ""));
  }

  void keep(const RefineTaskResult& made)
  {
    for (const subdomain::FillResult& result : made.results) own_.add(result);
    folds_.insert(folds_.end(), made.folds.begin(), made.folds.end());
  }

  const config::Case& run_case_;
  const RefineWork& work_;
  const FilledPieces& filled_;
  RunContext& context_;
  StageScope& stage_;
  PieceStore pieces_;
  std::optional<subdomain::LayerTables> layers_;  // After the split.
  PieceSurfaces surfaces_;
  std::vector<std::vector<LocalIndex>> neighbours_;
  Hash128 origin_;
  FilledPieces own_{};
  std::vector<mesh::PointLimit> folds_{};
  std::int64_t num_done_ = 0;
};

// New limits are always lower than those before; so this ends.
mesh::ProjectionLimiter lowered(const mesh::ProjectionLimiter& limiter,
                                const std::vector<mesh::PointLimit>& folds, const RefineWork& work)
{
  std::vector<mesh::PointLimit> entries(limiter.entries().begin(), limiter.entries().end());
  const auto found = mesh::on_whole_orbits(folds, work.cut.skeleton.orbits);
  entries.insert(entries.end(), found.begin(), found.end());
  mesh::ProjectionLimiter lower(std::move(entries));
  if (lower == limiter) {
    throw MeshError(
        fmt::format("tets are folded although their points are held back from the geometry; try {}",
                    work.split.is_curved ? "output.order = 1" : "a larger fill.levels"));
  }
  return lower;
}

// Ids were given before any piece was split.
void require_counted(const std::vector<subdomain::PieceSummary>& pieces,
                     const std::vector<number::PieceCounts>& counts)
{
  for (const subdomain::PieceSummary& piece : pieces) {
    if (subdomain::counts_of(piece) == counts[at(piece.subdomain)]) continue;
    throw MeshError(fmt::format("piece {} does not hold what was reckoned before it was split",
                                piece.subdomain));
  }
}

}  // namespace

LimitedPieces run_refine_stage(const config::Case& run_case, const RefineWork& work,
                               LimitedPieces before, RunContext& context)
{
  FilledPieces& filled = before.filled;
  mesh::ProjectionLimiter& limiter = before.limiter;
  const auto num_steps = 2 * std::ssize(filled.pieces) + std::ssize(work.ranges);
  StageScope stage(context, work.split.is_curved ? Stage::curve : Stage::refine, num_steps,
                   "pieces");
  StageWork stage_work(run_case, work, filled, context, stage);
  const std::vector<number::PieceCounts> counts = stage_work.count_pieces();
  load_refinement({.split = work.split,
                   .counts = counts,
                   .length_unit = work.length_unit,
                   .has_files = work.has_files},
                  run_case.output, context);
  FilledPieces all;
  std::vector<mesh::PointLimit> folds;
  for (;;) {
    load_limiter(limiter, context);
    std::tie(all, folds) = stage_work.refine_all(limiter);
    if (all.folded.empty()) break;
    all_or_none(context.comm, [&] { limiter = lowered(limiter, folds, work); });
  }
  all_or_none(context.comm, [&] { require_counted(all.pieces, counts); });
  all.seam_sums = std::move(filled.seam_sums);
  all.failures = std::move(filled.failures);
  all.improvement = filled.improvement;
  all.are_refined = true;
  stage.finish(fmt::format("{} tets", all.num_tets()));
  return {std::move(all), std::move(limiter)};
}

}  // namespace tessera::pipeline
