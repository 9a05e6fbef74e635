// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tessera/improve/seam_regions.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/piece_batch.hpp"

namespace tessera::pipeline {

/// @brief A PieceBatch of a fill job: its pieces know which try they come from.
class BatchFiller {
 public:
  /// @param[in] numbers nullptr if the ids are not known yet. All are borrowed.
  BatchFiller(const FillTask& task, const std::filesystem::path& output,
              const subdomain::WriteContext* numbers, const io::OutputOptions& options);

  /// @brief From now on pieces leave what the improvement of their seams needs. Borrowed.
  void keep_seams(const improve::SeamRegions& regions) { regions_ = &regions; }

  /// @throws MeshError if the piece is not better than the one that is to beat.
  void add(subdomain::FilledPiece filled);

  /// @return Bytes of the fill results. @throws OutputError
  [[nodiscard]] Bytes finish() && { return to_bytes(std::move(batch_).finish()); }

 private:
  const FillTask& task_;
  PieceBatch batch_;
  const improve::SeamRegions* regions_ = nullptr;
};

}  // namespace tessera::pipeline
