// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/batch_filler.hpp"

#include <utility>

#include "tessera/base/error.hpp"

#include "pipeline/store/band_segments.hpp"

namespace tessera::pipeline {

BatchFiller::BatchFiller(const FillTask& task, const std::filesystem::path& output,
                         const subdomain::WriteContext* numbers, const io::OutputOptions& options)
    : task_(task),
      batch_({.output = output,
              .record = record_name(task.batch),
              .file = task.batch,
              .plan = task.plan,
              .keep = task.keep},
             numbers, options)
{
}

void BatchFiller::add(subdomain::FilledPiece filled)
{
  subdomain::PieceSummary& summary = filled.result.summary;
  summary.tries = task_.tries;
  summary.was_limited = task_.was_limited;
  filled.result.failures = task_.failures;
  if (!summary.is_folded && summary.tets.min_dihedral_deg <= task_.angle_to_beat_deg) {
    throw MeshError("the fill is not better than the one before");
  }
  std::vector<Bytes> seams;
  if (regions_ != nullptr && task_.keep && !summary.is_folded) {
    improve::PiecePart part = improve::whole_piece(std::move(filled.piece));
    seams = band_segments(part, *regions_, 0, most_of_rim(summary.num_tets));
    filled.piece = std::move(part.piece);
  }
  batch_.add(std::move(filled), std::move(seams));
}

}  // namespace tessera::pipeline
