// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {

/// @brief What a fill job does with its pieces, one after the other. If the ids are known a piece
/// goes into the output file, else into the record of the store.
class BatchFiller {
 public:
  /// @param[in] numbers nullptr if the ids are not known yet. All are borrowed.
  BatchFiller(const FillTask& task, const std::filesystem::path& output,
              const subdomain::WriteContext* numbers, const io::OutputOptions& options);

  /// @throws MeshError if the piece is not better than the one that is to beat.
  void add(subdomain::FilledPiece filled);

  /// @brief Writes file and record, unless a subdomain was folded or nothing is to be kept.
  /// @return Bytes of the fill results. @throws OutputError
  [[nodiscard]] Bytes finish() &&;

 private:
  void keep();

  const FillTask& task_;
  const std::filesystem::path& output_;
  std::optional<subdomain::PieceFile> file_{};
  FillRecord record_{};
  bool is_folded_ = false;
  double cpu_before_s_;
};

}  // namespace tessera::pipeline
