// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/piece_batch.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tessera/jobs/this_process.hpp"

namespace tessera::pipeline {

PieceBatch::PieceBatch(BatchTarget target, const subdomain::WriteContext* numbers,
                       const io::OutputOptions& options)
    : target_(std::move(target)), cpu_before_s_(jobs::cpu_time_of_this_process())
{
  record_.plan = target_.plan;
  if (numbers != nullptr) file_.emplace(*numbers, options);
}

void PieceBatch::add(subdomain::FilledPiece filled, std::vector<Bytes> more)
{
  subdomain::PieceSummary& summary = filled.result.summary;
  is_folded_ = is_folded_ || summary.is_folded;
  summary.cpu_s = jobs::cpu_time_of_this_process() - cpu_before_s_;
  cpu_before_s_ += summary.cpu_s;
  if (!summary.is_folded) {
    if (file_) {
      summary.digest = file_->add(std::move(filled.piece));
    } else {
      segments_.push_back(to_bytes(filled.piece));
      summary.content = hash_bytes(segments_.back());
      std::ranges::move(more, std::back_inserter(segments_));
    }
  }
  record_.results.push_back(std::move(filled.result));
}

std::vector<subdomain::FillResult> PieceBatch::finish() &&
{
  if (!is_folded_ && target_.keep) keep();
  return std::move(record_.results);
}

void PieceBatch::keep()
{
  if (file_) {
    for (const std::filesystem::path& file : file_->write(target_.output, target_.file)) {
      record_.files.push_back(measure_file(target_.output, file));
    }
  }
  segments_.front() = to_bytes(record_);
  io::RecordStore(store_folder(target_.output)).put(target_.record, segments_);
}

}  // namespace tessera::pipeline
