// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/improve_stage.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/stages/load_stage.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"
#include "pipeline/store/region_records.hpp"

namespace tessera::pipeline {
namespace {

std::string phase_name(int phase) { return fmt::format("phase_{}", phase); }

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

// The regions of each phase that are to be improved.
std::array<std::vector<LocalIndex>, improve::kNumPhases> wanted_regions(
    const improve::SeamRegions& regions, const std::vector<fill::KernelKind>& kernels)
{
  std::array<std::vector<LocalIndex>, improve::kNumPhases> wanted;
  for (LocalIndex region = 0; region < regions.num_regions(); ++region) {
    const LocalIndex subdomain = regions.subdomains_of(region).front();
    if (kernels[at(subdomain)] == fill::KernelKind::subdivide) continue;
    wanted[static_cast<std::size_t>(regions.phase_of(region))].push_back(region);
  }
  return wanted;
}

class SeamImprover {
 public:
  SeamImprover(const config::Case& run_case, const subdomain::PartitionedMesh& cut,
               const improve::SeamRegions& regions, FilledPieces filled, RunContext& context,
               StageScope& stage)
      : run_case_(run_case),
        cut_(cut),
        regions_(regions),
        filled_(std::move(filled)),
        context_(context),
        stage_(stage),
        store_(store_folder(context.folder))
  {
    filled_.improvement.volume_before = volume_of(filled_.pieces);
    all_or_none(context_.comm, [&] {
      if (context_.comm.rank() == 0) drop_records_of_other_pieces();
    });
  }

  // Makes the next generation of pieces, unless a stopped run has done so.
  void run_phase(int phase, const std::vector<LocalIndex>& wanted)
  {
    const int before = filled_.improvement.generation;
    auto kept = on_root(context_.comm, [&] { return find_counts(phase); });
    Counts counts(4, 0);
    if (kept) {
      counts = std::move(*kept);
      num_done_ += std::ssize(wanted) + std::ssize(filled_.pieces);
    } else {
      counts = improve_regions(wanted);
      merge(phase);
      finish_phase(phase, before, counts);
    }
    Improvement& improvement = filled_.improvement;
    improvement.generation = phase + 1;
    improvement.num_regions += counts[0];
    improvement.num_improved += counts[1];
    improvement.num_failed += counts[2];
    improvement.num_limited += counts[3];
  }

  // Who owns which vertex, and the figures of the pieces as they are now.
  [[nodiscard]] FilledPieces number_shared_vertices() &&
  {
    const ImprovedPieces pieces(context_.folder, cut_.skeleton, filled_.improvement.generation);
    for_each_subdomain([&](LocalIndex s) { pieces.keep_list(pieces.piece(s)); });
    FilledPieces own;
    own.seam_sums.resize(filled_.seam_sums.size());
    for_each_subdomain([&](LocalIndex s) {
      own.add(subdomain::measure_improved_piece(pieces.piece(s), pieces.own_vertices(s),
                                                filled_.pieces[at(s)]));
    });
    FilledPieces all = combine(std::move(own), context_.comm);
    all.seam_sums = std::move(filled_.seam_sums);
    all.failures = std::move(filled_.failures);
    all.improvement = filled_.improvement;
    return all;
  }

 private:
  // Those of a phase that is done.
  [[nodiscard]] std::optional<Counts> find_counts(int phase) const
  {
    const auto record = store_.find(phase_name(phase));
    return record ? std::optional(from_bytes<Counts>(*record)) : std::nullopt;
  }

  // Updates name vertices by their numbers in the pieces, and a resumed run may have other pieces.
  // A poor piece is filled again, and its second try may succeed now where a limit had ended it.
  void drop_records_of_other_pieces() const
  {
    const std::string name = "improve";
    std::vector<Hash128> contents;
    for (const subdomain::PieceSummary& piece : filled_.pieces) contents.push_back(piece.content);
    const Bytes pieces = to_bytes(contents);
    if (store_.find(name) == pieces && newest_pieces_are_whole()) return;
    if (store_.contains(name)) remove_records();
    store_.put(name, pieces);
  }

  // Of the last phase that is done; those before it are gone.
  [[nodiscard]] bool newest_pieces_are_whole() const
  {
    int generation = improve::kNumPhases;
    while (generation > 0 && !store_.contains(phase_name(generation - 1))) --generation;
    return generation == 0
           || std::ranges::all_of(filled_.pieces, [&](const subdomain::PieceSummary& piece) {
                return store_.find(improved_name(piece.subdomain, generation)).has_value();
              });
  }

  void remove_records() const
  {
    for (LocalIndex r = 0; r < regions_.num_regions(); ++r) store_.remove(region_name(r));
    for (int phase = 0; phase < improve::kNumPhases; ++phase) {
      store_.remove(phase_name(phase));
      for (const subdomain::PieceSummary& piece : filled_.pieces) {
        store_.remove(improved_name(piece.subdomain, phase + 1));
      }
    }
  }

  [[nodiscard]] ImproveContext phase_context() const
  {
    return {cut_, regions_, store_, filled_.improvement.generation};
  }

  void for_each_subdomain(const std::function<void(LocalIndex)>& work)
  {
    for_each_dynamic(in_order(filled_.pieces.size()), in_thread(work), stage_, context_, num_done_);
    num_done_ += std::ssize(filled_.pieces);
  }

  [[nodiscard]] double num_tets_around(LocalIndex region) const
  {
    double sum = 0.0;
    for (const LocalIndex s : regions_.subdomains_of(region)) {
      sum += static_cast<double>(filled_.pieces[at(s)].num_tets);
    }
    return sum;
  }

  [[nodiscard]] Counts improve_regions(const std::vector<LocalIndex>& wanted)
  {
    std::vector<double> weights;
    for (const LocalIndex region : wanted) weights.push_back(num_tets_around(region));
    Counts counts(4, 0);
    for_each_dynamic(
        heaviest_first(weights),
        [&](LocalIndex row, const auto& on_wait) {
          const LocalIndex region = wanted[at(row)];
          add(counts_of(improve(region, weights[at(row)], on_wait)), counts);
        },
        stage_, context_, num_done_);
    num_done_ += std::ssize(wanted);
    context_.comm.sum_in_place(counts);
    return counts;
  }

  // A region that fails keeps its tets: they are those of valid pieces.
  subdomain::RegionRecord improve(LocalIndex region, double num_tets,
                                  const jobs::JobRunner::WaitCallback& on_wait)
  {
    if (const auto kept = store_.find(region_name(region)))
      return from_bytes<subdomain::RegionRecord>(*kept);
    const std::string name = fmt::format("improve: region {}", region);
    jobs::JobOutcome outcome =
        run_job({name, improve_request(region, filled_.improvement.generation),
                 job_limits(run_case_.fill, num_tets)},
                on_wait, context_);
    throw_unless_of_the_job(outcome);
    // A piece that cannot be read is no fault of the region.
    if (outcome.error == ErrorKind::input) throw InputError(outcome.message + way_on(outcome));
    subdomain::RegionRecord record;
    if (auto made = read_result(outcome, [&](const Bytes& /*empty*/) {
          return from_bytes<subdomain::RegionRecord>(store_.get(region_name(region)));
        })) {
      record = std::move(*made);
    } else {
      record = {.has_failed = true,
                .was_limited = depends_on_machine(outcome),
                .reason = outcome.message};
      keep_failure(region, name, outcome);
      store_.put(region_name(region), to_bytes(record));
    }
    if (!record.is_improved) context_.log.debug("{} stays as it is: {}", name, record.reason);
    return record;
  }

  // With its pieces: those in the store go when the run is over.
  void keep_failure(LocalIndex region, const std::string& name, const jobs::JobOutcome& outcome)
  {
    const std::vector<mesh::Piece> pieces = pieces_around(phase_context(), region);
    const Bytes request = improve_pieces_request(region, pieces);
    const jobs::JobLimits limits;
    const auto kept = keep_failed_job({name, request, limits}, request, outcome, context_);
    keep_meshes_of_failed_region(
        kept, [&] { return subdomain::region_mesh(pieces, regions_, region); }, cut_.coarse,
        cut_.decomposition, context_);
  }

  void merge(int phase)
  {
    const ImproveContext phase_work = phase_context();
    for_each_subdomain([&](LocalIndex s) {
      const std::string name = improved_name(s, phase + 1);
      if (store_.find(name)) return;
      store_.put(name, to_bytes(merge_regions(phase_work, s, phase)));
    });
  }

  // From here on the phase counts as done: what only it needed can go. The pieces as they were
  // filled stay, for a resumed run asks for them.
  void finish_phase(int phase, int before, const Counts& counts)
  {
    all_or_none(context_.comm, [&] {
      if (context_.comm.rank() != 0) return;
      store_.put(phase_name(phase), to_bytes(counts));
      for (LocalIndex r = regions_.first_of_phase(phase); r < regions_.first_of_phase(phase + 1);
           ++r) {
        store_.remove(region_name(r));
      }
      for (const subdomain::PieceSummary& piece : filled_.pieces) {
        if (before > 0) store_.remove(improved_name(piece.subdomain, before));
      }
    });
  }

  const config::Case& run_case_;
  const subdomain::PartitionedMesh& cut_;
  const improve::SeamRegions& regions_;
  FilledPieces filled_;
  RunContext& context_;
  StageScope& stage_;
  io::RecordStore store_;
  std::int64_t num_done_ = 0;
};

}  // namespace

FilledPieces run_improve_stage(const config::Case& run_case, const subdomain::PartitionedMesh& cut,
                               const std::vector<fill::KernelKind>& kernels, FilledPieces filled,
                               RunContext& context)
{
  const improve::SeamRegions regions(cut.skeleton, cut.decomposition);
  const auto wanted = wanted_regions(regions, kernels);
  std::int64_t num_regions = 0;
  std::int64_t num_passes =
      2;  // Over all pieces: those of number_shared_vertices(), and one a phase.
  for (const auto& phase : wanted) {
    num_regions += std::ssize(phase);
    num_passes += phase.empty() ? 0 : 1;
  }
  if (num_regions == 0) return filled;
  const std::int64_t num_steps = num_regions + num_passes * std::ssize(filled.pieces);
  StageScope stage(context, "improve", num_steps, "regions and pieces");
  load_improvement(run_case.improve, kernels, context);
  SeamImprover improver(run_case, cut, regions, std::move(filled), context, stage);
  for (int phase = 0; phase < improve::kNumPhases; ++phase) {
    const auto& regions_of_phase = wanted[static_cast<std::size_t>(phase)];
    if (!regions_of_phase.empty()) improver.run_phase(phase, regions_of_phase);
  }
  FilledPieces all = std::move(improver).number_shared_vertices();
  stage.finish(
      fmt::format("{} of {} regions are better", all.improvement.num_improved, num_regions));
  return all;
}

}  // namespace tessera::pipeline
