// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/formats/piece.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Writes the mesh, whose piece files are complete, in the case's other formats. Does
/// nothing if it has none, and no parts whose neighbours are to be known.
/// @note Collective. @throws on every rank as formats::export_mesh().
/// @return Who shares points with each piece file, shape (num_files); empty if nothing was done.
[[nodiscard]] std::vector<formats::PieceCounts> run_export_stage(const config::Case& run_case,
                                                                 RunContext& context);

}  // namespace tessera::pipeline
