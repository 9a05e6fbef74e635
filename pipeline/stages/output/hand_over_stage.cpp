// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/hand_over_stage.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/output/write_stage.hpp"

namespace tessera::pipeline {
namespace {

// Of the pieces that were made, in the order of subdomains; they may be some only.
std::ptrdiff_t row_of(LocalIndex subdomain, const std::vector<subdomain::PieceSummary>& pieces)
{
  return std::ranges::lower_bound(pieces, subdomain, {}, &subdomain::PieceSummary::subdomain)
         - pieces.begin();
}

// Whatever the caller throws is an error of this rank: it must not pass for a stop signal, nor for
// an error that all ranks have thrown already.
void call(const PieceSink& on_piece, LocalIndex number, subdomain::PieceArrays piece, Rank rank)
{
  const std::string what = fmt::format("on_piece has failed on rank {} for piece {}", rank, number);
  try {
    on_piece(number, std::move(piece));
  } catch (const std::exception& error) {
    throw OutputError(what + ": " + error.what());
  } catch (...) {
    throw OutputError(what);
  }
}

}  // namespace

std::vector<Hash128> run_hand_over_stage(const std::vector<subdomain::SubdomainRange>& files,
                                         const subdomain::WriteContext& mesh,
                                         const PieceSink& on_piece, const FilledPieces& filled,
                                         RunContext& context)
{
  StageScope stage(context, Stage::hand_over, static_cast<std::int64_t>(files.size()), "pieces");
  const PieceStore store = store_of(filled, context.folder);
  std::vector<Hash128> digests(filled.pieces.size());
  const io::OutputOptions plain;
  subdomain::PieceArrays piece;
  const ItemWork gather = in_thread([&](LocalIndex file) {
    GatheredFile gathered = gather_file(files[at(file)], plain, mesh, store);
    std::ranges::copy(gathered.digests,
                      digests.begin() + row_of(files[at(file)].first, filled.pieces));
    piece = std::move(gathered.file).take();
  });
  const auto hand_over = [&](LocalIndex file, const jobs::JobRunner::WaitCallback& on_wait) {
    gather(file, on_wait);
    call(on_piece, files[at(file)].number, std::move(piece), context.comm.rank());
  };
  for_each_dynamic(in_order(files.size()), hand_over, stage, context);
  context.comm.sum_in_place(digests);
  stage.finish(fmt::format("{} pieces", files.size()));
  return digests;
}

}  // namespace tessera::pipeline
