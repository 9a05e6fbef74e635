// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/filled_pieces.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

namespace tessera::pipeline {
namespace {

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

std::vector<subdomain::FailedTries> gather(const std::vector<subdomain::FailedTries>& own,
                                           const comm::Communicator& comm)
{
  std::vector<subdomain::FailedTries> all;
  for (const Bytes& bytes : comm.all_gather(to_bytes(own))) {
    std::ranges::move(subdomain::failed_tries_from_bytes(bytes), std::back_inserter(all));
  }
  std::ranges::sort(all, {}, &subdomain::FailedTries::subdomain);
  return all;
}

}  // namespace

GlobalIndex FilledPieces::num_tets() const
{
  GlobalIndex num_tets = 0;
  for (const subdomain::PieceSummary& piece : pieces) num_tets += piece.num_tets;
  return num_tets;
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
  for (const verify::SeamHash& seam : result.seams) seam_sums[at(seam.triangle)] += seam.hash;
}

FilledPieces combine(FilledPieces own, const comm::Communicator& comm)
{
  FilledPieces all;
  all.pieces = gather(own.pieces, comm);
  all.folded = gather(own.folded, comm);
  all.failures = gather(own.failures, comm);
  std::ranges::sort(all.folded, {}, &FoldedSubdomain::subdomain);
  std::sort(all.pieces.begin(), all.pieces.end(),
            [](const subdomain::PieceSummary& a, const subdomain::PieceSummary& b) {
              return a.subdomain < b.subdomain;
            });
  all.histograms = std::move(own.histograms);
  sum_over_ranks(all.histograms.mean_ratio, comm);
  sum_over_ranks(all.histograms.seam_mean_ratio, comm);
  sum_over_ranks(all.histograms.log2_edge_length, comm);
  all.seam_sums = std::move(own.seam_sums);
  comm.sum_in_place(all.seam_sums);
  return all;
}

}  // namespace tessera::pipeline
