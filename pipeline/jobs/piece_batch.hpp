// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {

/// @brief Where the pieces of one job go.
struct BatchTarget {
  std::filesystem::path output{};  ///< The output folder.
  std::string record{};            ///< Name of the record in the store.
  LocalIndex file = 0;             ///< Number of the file, if ids are known.
  Hash128 plan{};                  ///< What the pieces were made from, for the record.
  bool keep = true;                ///< false: measure only and store nothing, for a replay.
};

/// @brief What a job does with its pieces, one after the other. If the ids are known a piece goes
/// into the output file, else into the record of the store.
class PieceBatch {
 public:
  /// @param[in] numbers nullptr if the ids are not known yet. Both are borrowed.
  PieceBatch(BatchTarget target, const subdomain::WriteContext* numbers,
             const io::OutputOptions& options);

  /// @param[in] more Segments of the record behind the piece.
  void add(subdomain::FilledPiece filled, std::vector<Bytes> more = {});

  /// @brief Writes file and record, unless a subdomain was folded or nothing is to be kept.
  /// @return The fill results. @throws OutputError
  [[nodiscard]] std::vector<subdomain::FillResult> finish() &&;

 private:
  void keep();

  BatchTarget target_;
  std::optional<subdomain::PieceFile> file_{};
  FillRecord record_{};
  std::vector<Bytes> segments_{Bytes{}};  ///< Of the record; the head comes last.
  bool is_folded_ = false;
  double cpu_before_s_;
};

}  // namespace tessera::pipeline
