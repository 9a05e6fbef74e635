// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/formats/piece.hpp"
#include "tessera/io/options.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What a mesh is written in besides piece files. Local.
[[nodiscard]] std::vector<io::Format> other_formats(const io::OutputOptions& options);

/// @brief Writes the mesh, whose piece files are complete, in the case's other formats. If it has
/// none, looks only who the neighbours of each part are.
/// @note Collective. @throws on every rank as formats::export_mesh().
/// @return Who shares points with each piece file, shape (num_files).
[[nodiscard]] std::vector<formats::PieceCounts> run_export_stage(const config::Case& run_case,
                                                                 RunContext& context);

}  // namespace tessera::pipeline
