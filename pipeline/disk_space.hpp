// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/io/options.hpp"

#include "pipeline/piece_file.hpp"
#include "pipeline/run_pipeline.hpp"

namespace tessera::pipeline {

/// @brief Bytes on disk that so many tets will take when written, and while they wait in the store.
struct DiskNeed {
  double files = 0.0;
  double store = 0.0;
};

/// @brief Estimate from the number of tets and of vertices. Local.
[[nodiscard]] DiskNeed predict_disk_need(double num_tets, bool is_one_pass,
                                         const io::OutputOptions& options);

/// @brief Refuses to begin what cannot be finished: the free space must hold what is predicted for
/// the ranges that are to be filled.
/// @note Collective. @throws OutputError on every rank, with both numbers and what to change.
void require_disk_space(const RunResult& run, const std::vector<SubdomainRange>& ranges,
                        RunContext& context);

}  // namespace tessera::pipeline
