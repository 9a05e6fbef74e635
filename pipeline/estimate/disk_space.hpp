// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/io/options.hpp"

#include "pipeline/estimate/rates.hpp"
#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What a run writes.
struct DiskNeed {
  GlobalIndex num_files = 0;  ///< In mesh/ and boundary/.
  double file_bytes = 0.0;    ///< Of those files.
  double store_bytes = 0.0;   ///< Of the pieces that wait for their ids; gone at the end.
};

/// @brief What is in some folders.
struct FolderSize {
  double num_files = 0.0;
  double bytes = 0.0;
};

/// @brief Sizes up the folders of these names below `parent`; one that is missing is empty. Local.
[[nodiscard]] FolderSize size_of_folders(const std::filesystem::path& parent,
                                         const std::vector<std::string>& names);

/// @brief Adds up the files of an outline. Local.
[[nodiscard]] DiskNeed disk_need(const RunOutline& outline, const Rates& rates);

/// @brief Refuses to begin what cannot be finished: the free space must hold what the outline needs
/// at the built-in rates.
/// @note Collective. @throws OutputError on every rank, with both numbers and what to change.
void require_disk_space(const RunOutline& outline, const io::OutputOptions& options,
                        RunContext& context);

}  // namespace tessera::pipeline
