// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/improve_stage.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/subdomain/core_figures.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/store/band_segments.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// How the regions of one phase have ended: tried, improved, failed, limited.
using Counts = std::vector<GlobalIndex>;

Counts counts_of(const subdomain::RegionRecord& record)
{
  return {1, record.is_improved ? 1 : 0, record.has_failed ? 1 : 0, record.was_limited ? 1 : 0};
}

void add(const Counts& counts, Counts& sum)
{
  std::ranges::transform(counts, sum, sum.begin(), std::plus<>());
}

double volume_of(const std::vector<subdomain::PieceSummary>& pieces)
{
  double volume = 0.0;
  for (const subdomain::PieceSummary& piece : pieces) volume += piece.volume;
  return volume;
}

using RegionsByPhase = std::array<std::vector<LocalIndex>, improve::kNumPhases>;

// The regions of each phase that are to be improved.
RegionsByPhase wanted_regions(const improve::SeamRegions& regions,
                              const std::vector<fill::KernelKind>& kernels)
{
  RegionsByPhase wanted;
  for (LocalIndex region = 0; region < regions.num_regions(); ++region) {
    const LocalIndex subdomain = regions.subdomains_of(region).front();
    if (kernels[at(subdomain)] == fill::KernelKind::subdivide) continue;
    wanted[static_cast<std::size_t>(regions.phase_of(region))].push_back(region);
  }
  return wanted;
}

// By phase, the pieces that its regions lie in, ascending. None in phase 0, whose bands come from
// the fills.
RegionsByPhase pieces_of_phases(const improve::SeamRegions& regions, const RegionsByPhase& wanted)
{
  RegionsByPhase pieces;
  for (std::size_t phase = 1; phase < wanted.size(); ++phase) {
    std::vector<LocalIndex>& some = pieces[phase];
    for (const LocalIndex region : wanted[phase]) {
      std::ranges::copy(regions.subdomains_of(region), std::back_inserter(some));
    }
    sort_unique(some);
  }
  return pieces;
}

std::int64_t total_size(const auto& lists)
{
  std::int64_t size = 0;
  for (const auto& list : lists) size += std::ssize(list);
  return size;
}

// Updates name vertices by their tags in the pieces, and a resumed run may have other pieces. A
// poor piece is filled again, and its second try may succeed now where a limit had ended it.
void drop_records_of_other_pieces(const std::vector<subdomain::PieceSummary>& pieces,
                                  const io::RecordStore& store, const fs::path& folder)
{
  const std::string name = "improve";
  std::vector<Hash128> contents;
  for (const subdomain::PieceSummary& piece : pieces) contents.push_back(piece.content);
  const Bytes record = to_bytes(contents);
  if (store.find(name) == record) return;
  io::remove_logs(folder);
  store.put(name, record);
}

// Regions that one job improves.
struct RegionBatch {
  std::vector<LocalIndex> regions{};
  double num_tets = 0.0;  // As num_tets_around().
};

using BatchesByPhase = std::array<std::vector<RegionBatch>, improve::kNumPhases>;

// Of the pieces that the regions lie in: a bound of their work that is known before bands are.
double num_tets_around(const std::vector<LocalIndex>& some, const improve::SeamRegions& regions,
                       const std::vector<subdomain::PieceSummary>& pieces)
{
  double sum = 0.0;
  for (const LocalIndex region : some) {
    for (const LocalIndex s : regions.subdomains_of(region)) {
      sum += static_cast<double>(pieces[at(s)].num_tets);
    }
  }
  return sum;
}

// The regions of a phase, some to a job. To start a job takes as long as to improve several small
// regions, but a rank that is done must not wait long for others.
std::vector<RegionBatch> batches_of(const std::vector<LocalIndex>& wanted,
                                    const improve::SeamRegions& regions,
                                    const std::vector<subdomain::PieceSummary>& pieces,
                                    int num_ranks)
{
  constexpr double kMostTets = 200'000.0;
  constexpr double kLeastBatchesOfRank = 8.0;
  const double most = std::min(
      kMostTets, num_tets_around(wanted, regions, pieces) / (kLeastBatchesOfRank * num_ranks));
  std::vector<RegionBatch> batches;
  for (const LocalIndex region : wanted) {
    const double num_tets = num_tets_around({region}, regions, pieces);
    if (batches.empty() || batches.back().num_tets + num_tets > most) batches.emplace_back();
    batches.back().regions.push_back(region);
    batches.back().num_tets += num_tets;
  }
  return batches;
}

// What the improvement works on; the same on every rank.
struct SeamWork {
  const improve::SeamRegions& regions;
  BatchesByPhase batches{};
  RegionsByPhase pieces{};  // That take part.

  [[nodiscard]] bool takes_part(LocalIndex piece, int phase) const
  {
    return std::ranges::binary_search(pieces[static_cast<std::size_t>(phase)], piece);
  }

  // The piece's last phase before that one, or phase 0: the fill has left bands and a rim for it.
  [[nodiscard]] int phase_before(LocalIndex piece, int phase) const
  {
    do {
      --phase;
    } while (phase > 0 && !takes_part(piece, phase));
    return phase;
  }
};

class SeamImprover {
 public:
  SeamImprover(const config::Case& run_case, const subdomain::PartitionedMesh& cut,
               const SeamWork& work, FilledPieces filled, std::shared_ptr<ImprovedPieces> pieces,
               RunContext& context, StageScope& stage)
      : run_case_(run_case),
        cut_(cut),
        work_(work),
        filled_(std::move(filled)),
        pieces_(std::move(pieces)),
        context_(context),
        stage_(stage)
  {
    filled_.improvement.volume_before = volume_of(filled_.pieces);
  }

  void run_phase(int phase)
  {
    const auto row = static_cast<std::size_t>(phase);
    if (phase > 0) make_bands(phase, work_.pieces[row]);
    const Counts counts = improve_regions(work_.batches[row]);
    context_.log.debug(
        fmt::format("improve: phase {}: {} jobs of regions", phase, work_.batches[row].size()));
    Improvement& improvement = filled_.improvement;
    improvement.num_regions += counts[0];
    improvement.num_improved += counts[1];
    improvement.num_failed += counts[2];
    improvement.num_limited += counts[3];
  }

  // Who owns which vertex, and the figures of the pieces as they are now.
  [[nodiscard]] FilledPieces number_shared_vertices() &&
  {
    FilledPieces own;
    own.seam_sums.resize(filled_.seam_sums.size());
    for_each_dynamic(in_order(filled_.pieces.size()),
                     in_thread([&](LocalIndex s) { measure(s, own); }), stage_, context_,
                     num_done_);
    pieces_->records().share();
    context_.log.debug("improve: lists of pieces");
    all_or_none(context_.comm, [&] {
      for (subdomain::PieceSummary& piece : own.pieces) add_owned(piece, own.histograms);
    });
    pieces_->records().share();
    FilledPieces all = combine(std::move(own), context_.comm);
    all.seam_sums = std::move(filled_.seam_sums);
    all.failures = std::move(filled_.failures);
    all.improvement = filled_.improvement;
    all.improvement.pieces = pieces_;
    return all;
  }

 private:
  // Of the pieces as the phases before have left them.
  void make_bands(int phase, const std::vector<LocalIndex>& pieces)
  {
    for_each_dynamic(pieces, in_thread([&](LocalIndex s) {
                       if (pieces_->has_bands(s, phase)) return;
                       pieces_->keep_bands(s, work_.phase_before(s, phase), phase,
                                           most_of_rim(filled_.pieces[at(s)].num_tets));
                     }),
                     stage_, context_, num_done_);
    num_done_ += std::ssize(pieces);
    pieces_->records().share();
    context_.log.debug(fmt::format("improve: phase {}: bands of {} pieces", phase, pieces.size()));
  }

  void measure(LocalIndex s, FilledPieces& own)
  {
    const ImprovedPieces::Outer outer = pieces_->outer(s);
    subdomain::FillResult result = measure_part(outer.part, expected_seams(outer.part));
    subdomain::add_core(outer.core, outer.part, result);
    own.add(result);
    pieces_->keep_list(outer);
  }

  // What the lists will say of a part's seams, but for a vertex in ten thousand that one of two
  // pieces has lost.
  [[nodiscard]] std::vector<char> expected_seams(const improve::PiecePart& part) const
  {
    return improve::vertices_perhaps_on_seams(part.piece, work_.regions);
  }

  [[nodiscard]] subdomain::FillResult measure_part(const improve::PiecePart& part,
                                                   const std::vector<char>& on_seam) const
  {
    return subdomain::measure_improved_part(part, on_seam,
                                            filled_.pieces[at(part.piece.subdomain)]);
  }

  // The tets of a piece that may be on seams, and others.
  [[nodiscard]] improve::PiecePart part_with_seams(LocalIndex s) const
  {
    ImprovedPieces::Outer outer = pieces_->outer(s);
    if (outer.core.figures.summary.seam_tets.num_tets == 0) return std::move(outer.part);
    return improve::whole_piece(pieces_->piece(s));
  }

  // Where the lists say something else of the seams than was expected, tets are measured once more.
  void add_owned(subdomain::PieceSummary& summary, quality::QualityHistograms& histograms)
  {
    const LocalIndex s = summary.subdomain;
    const ImprovedPieces::Comparison lists = pieces_->own_vertices(s);
    if (!lists.is_as_expected) {
      const improve::PiecePart part = part_with_seams(s);
      const auto expected = measure_part(part, expected_seams(part));
      const auto found = measure_part(part, lists.seams_of(part.piece));
      summary.seam_tets = found.summary.seam_tets;
      histograms.seam_mean_ratio.subtract(expected.histograms.seam_mean_ratio);
      histograms.seam_mean_ratio.add(found.histograms.seam_mean_ratio);
    }
    summary.num_owned_vertices =
        summary.num_interior_vertices + static_cast<GlobalIndex>(lists.shared.owned.size());
  }

  [[nodiscard]] Counts improve_regions(const std::vector<RegionBatch>& batches)
  {
    std::vector<double> weights;
    for (const RegionBatch& batch : batches) weights.push_back(batch.num_tets);
    Counts counts(4, 0);
    for_each_dynamic(
        heaviest_first(weights),
        [&](LocalIndex row, const auto& on_wait) {
          improve(batches[at(row)].regions, on_wait, counts);
        },
        stage_, context_, num_done_);
    num_done_ += std::ssize(batches);
    pieces_->records().share();
    context_.comm.sum_in_place(counts);
    return counts;
  }

  // Keeps a record of each region. If their job fails each gets a job of its own, which shows the
  // one to blame: that keeps its tets, as they are those of valid pieces.
  void improve(std::vector<LocalIndex> regions, const jobs::JobRunner::WaitCallback& on_wait,
               Counts& counts)
  {
    std::erase_if(regions, [&](LocalIndex region) {
      const bool is_there = pieces_->has_region(region);
      if (is_there) add(counts_of(pieces_->find_region(region)), counts);
      return is_there;
    });
    if (regions.empty()) return;
    const Bytes request = request_for(regions);
    const jobs::JobLimits limits = limits_of(regions);
    const std::string name = fmt::format("improve: region {}", fmt::join(regions, ", "));
    const JobRequest job{name, request, limits};
    const auto read = [&](const Bytes& result) {
      auto records = from_bytes<std::vector<subdomain::RegionRecord>>(result);
      if (records.size() == regions.size()) return records;
      throw InputError(fmt::format("it has {} regions, not {}", records.size(), regions.size()));
    };
    const auto [made, end, cpu_s] = attempt_job(job, read, on_wait, context_);
    throw_unless_of_the_job(end);
    if (made) {
      for (std::size_t i = 0; i < regions.size(); ++i) keep(regions[i], (*made)[i], counts);
    } else if (regions.size() > 1) {
      context_.log.debug(fmt::format("{}: {}; each gets a job of its own", name, end.message));
      for (const LocalIndex region : regions) improve({region}, on_wait, counts);
    } else {
      keep(regions.front(),
           {.has_failed = true, .was_limited = depends_on_machine(end), .reason = end.message},
           counts);
      keep_failure(regions.front(), job, end);
    }
  }

  // Those of the least region: what several can do within them, each could do alone. So it does not
  // depend on the number of ranks, as batches do, which regions meet a limit.
  [[nodiscard]] jobs::JobLimits limits_of(const std::vector<LocalIndex>& regions) const
  {
    double least = num_tets_around(regions, work_.regions, filled_.pieces);
    for (const LocalIndex region : regions) {
      least = std::min(least, num_tets_around({region}, work_.regions, filled_.pieces));
    }
    return job_limits(run_case_.fill, least);
  }

  [[nodiscard]] Bytes request_for(const std::vector<LocalIndex>& regions) const
  {
    std::vector<RegionToImprove> all;
    for (const LocalIndex region : regions) all.push_back({region, pieces_->bands_of(region)});
    return improve_request(std::move(all));
  }

  void keep(LocalIndex region, const subdomain::RegionRecord& record, Counts& counts)
  {
    pieces_->keep_region(region, record);
    add(counts_of(record), counts);
    if (record.is_improved) return;
    context_.log.debug(fmt::format("improve: region {} stays as it is: {}", region, record.reason));
  }

  void keep_failure(LocalIndex region, const JobRequest& job, const jobs::JobEnd& end)
  {
    const auto kept = keep_failed_job(job, job.request, end, context_);
    keep_meshes_of_failed_region(
        kept, [&] { return region_mesh(pieces_->bands_of(region), work_.regions, region); },
        cut_.coarse, cut_.decomposition, context_);
  }

  const config::Case& run_case_;
  const subdomain::PartitionedMesh& cut_;
  const SeamWork& work_;
  FilledPieces filled_;
  std::shared_ptr<ImprovedPieces> pieces_;
  RunContext& context_;
  StageScope& stage_;
  std::int64_t num_done_ = 0;
};

// Two subdomains of a material that are not subdivided. Where there are seams, nearly always some
// do: that is quicker to see than all regions are to make. A material has one kernel.
bool share_a_triangle(const subdomain::PartitionedMesh& cut,
                      const std::vector<fill::KernelKind>& kernels)
{
  const std::vector<LocalIndex>& material = cut.decomposition.subdomain_material;
  for (LocalIndex t = 0; t < cut.skeleton.num_triangles(); ++t) {
    const LocalIndex a = cut.skeleton.triangle_subdomains[2 * at(t)];
    const LocalIndex b = cut.skeleton.triangle_subdomains[2 * at(t) + 1];
    if (a == kNoIndex || b == kNoIndex || a == b || material[at(a)] != material[at(b)]) continue;
    if (kernels[at(a)] != fill::KernelKind::subdivide) return true;
  }
  return false;
}

}  // namespace

bool have_seams_to_improve(const subdomain::PartitionedMesh& cut,
                           const std::vector<fill::KernelKind>& kernels)
{
  if (are_counts_known(kernels)) return false;
  if (share_a_triangle(cut, kernels)) return true;
  const improve::SeamRegions regions(cut.skeleton, cut.decomposition);
  return total_size(wanted_regions(regions, kernels)) > 0;
}

FilledPieces run_improve_stage(const config::Case& run_case, const subdomain::PartitionedMesh& cut,
                               const std::vector<fill::KernelKind>& kernels, FilledPieces filled,
                               RunContext& context)
{
  const auto regions =
      std::make_shared<const improve::SeamRegions>(cut.skeleton, cut.decomposition);
  const RegionsByPhase wanted = wanted_regions(*regions, kernels);
  SeamWork work{.regions = *regions, .pieces = pieces_of_phases(*regions, wanted)};
  std::ranges::transform(wanted, work.batches.begin(), [&](const auto& some) {
    return batches_of(some, *regions, filled.pieces, context.comm.size());
  });
  const std::int64_t num_steps =
      total_size(work.batches) + total_size(work.pieces) + std::ssize(filled.pieces);
  StageScope stage(context, Stage::improve, num_steps, "jobs and pieces");
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    const fs::path folder = store_folder(context.folder);
    drop_records_of_other_pieces(filled.pieces, io::RecordStore(folder), folder);
  });
  auto pieces =
      std::make_shared<ImprovedPieces>(context.folder, cut.skeleton, regions, context.comm);
  SeamImprover improver(run_case, cut, work, std::move(filled), std::move(pieces), context, stage);
  for (int phase = 0; phase < improve::kNumPhases; ++phase) improver.run_phase(phase);
  FilledPieces all = std::move(improver).number_shared_vertices();
  stage.finish(
      fmt::format("{} of {} regions are better", all.improvement.num_improved, total_size(wanted)));
  return all;
}

}  // namespace tessera::pipeline
