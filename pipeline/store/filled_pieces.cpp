// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/filled_pieces.hpp"

#include <algorithm>
#include <utility>

namespace tessera::pipeline {
namespace {

void sum_over_ranks(quality::Histogram& histogram, const comm::Communicator& comm)
{
  std::vector<GlobalIndex> counts = histogram.counts();
  comm.sum_in_place(counts);
  histogram.set_counts(std::move(counts));
}

GlobalIndex sum_over(const std::vector<subdomain::PieceSummary>& pieces,
                     GlobalIndex (subdomain::PieceSummary::*count)() const)
{
  GlobalIndex sum = 0;
  for (const subdomain::PieceSummary& piece : pieces) sum += (piece.*count)();
  return sum;
}

}  // namespace

GlobalIndex FilledPieces::num_tets() const
{
  return sum_over(pieces, &subdomain::PieceSummary::num_all_tets);
}

GlobalIndex FilledPieces::num_cells() const
{
  return sum_over(pieces, &subdomain::PieceSummary::num_cells);
}

void FilledPieces::add(const subdomain::FillResult& result)
{
  if (!result.failures.empty()) failures.push_back({result.summary.subdomain, result.failures});
  if (result.summary.is_folded) {
    folded.push_back({result.summary.subdomain, result.summary.was_limited});
    return;
  }
  pieces.push_back(result.summary);
  histograms.add(result.histograms);
  worst.add(result.worst);
  for (const verify::SeamHash& seam : result.seams) seam_sums[at(seam.triangle)] += seam.hash;
}

FilledPieces combine(FilledPieces own, const comm::Communicator& comm)
{
  FilledPieces all;
  all.pieces = comm.all_gather_rows(own.pieces);
  all.folded = comm.all_gather_rows(own.folded);
  all.failures = comm.all_gather_rows(own.failures);
  std::ranges::sort(all.pieces, {}, &subdomain::PieceSummary::subdomain);
  std::ranges::sort(all.folded, {}, &FoldedSubdomain::subdomain);
  std::ranges::sort(all.failures, {}, &subdomain::FailedTries::subdomain);
  all.histograms = std::move(own.histograms);
  sum_over_ranks(all.histograms.mean_ratio, comm);
  sum_over_ranks(all.histograms.seam_mean_ratio, comm);
  sum_over_ranks(all.histograms.log2_edge_length, comm);
  sum_over_ranks(all.histograms.min_dihedral_deg, comm);
  sum_over_ranks(all.histograms.max_dihedral_deg, comm);
  for (const quality::WorstTets& worst : comm.all_gather_values(own.worst)) all.worst.add(worst);
  all.seam_sums = std::move(own.seam_sums);
  comm.sum_in_place(all.seam_sums);
  return all;
}

}  // namespace tessera::pipeline
