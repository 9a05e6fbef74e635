// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/batch_filler.hpp"

#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/jobs/this_process.hpp"

namespace tessera::pipeline {

BatchFiller::BatchFiller(const FillTask& task, const std::filesystem::path& output,
                         const subdomain::WriteContext* numbers, const io::OutputOptions& options)
    : task_(task), output_(output), cpu_before_s_(jobs::cpu_time_of_this_process())
{
  record_.plan = task.plan;
  if (numbers != nullptr) file_.emplace(*numbers, options);
}

void BatchFiller::add(subdomain::FilledPiece filled)
{
  subdomain::PieceSummary& summary = filled.result.summary;
  is_folded_ = is_folded_ || summary.is_folded;
  summary.tries = task_.tries;
  summary.was_limited = task_.was_limited;
  filled.result.failures = task_.failures;
  summary.cpu_s = jobs::cpu_time_of_this_process() - cpu_before_s_;
  cpu_before_s_ += summary.cpu_s;
  if (!summary.is_folded) {
    if (summary.tets.min_dihedral_deg <= task_.angle_to_beat_deg) {
      throw MeshError("the fill is not better than the one before");
    }
    if (file_) {
      summary.digest = file_->add(std::move(filled.piece));
    } else {
      record_.piece = to_bytes(filled.piece);
      summary.content = hash_bytes(record_.piece);
    }
  }
  record_.results.push_back(std::move(filled.result));
}

Bytes BatchFiller::finish() &&
{
  if (!is_folded_ && task_.keep) keep();
  return to_bytes(record_.results);
}

void BatchFiller::keep()
{
  if (file_) {
    for (const std::filesystem::path& file : file_->write(output_, task_.batch)) {
      record_.files.push_back(measure_file(output_, file));
    }
  }
  io::RecordStore(store_folder(output_)).put(record_name(task_.batch), to_bytes(record_));
}

}  // namespace tessera::pipeline
