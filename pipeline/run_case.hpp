// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/comm/communicator.hpp"
#include "tessera/config/case.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/tessera.hpp"

namespace tessera::pipeline {

/// @brief Runs a case in its folder, which is locked meanwhile: from the case to the mesh and its
/// report. Every rank has the same case. A run that fails leaves a report too.
/// @note Collective. The worker processes of `jobs` are those of make_mesh_worker().
/// @throws what the stages throw, on every rank.
[[nodiscard]] MeshResult run_case(const config::Case& given, const MeshOptions& options,
                                  const comm::Communicator& comm, jobs::JobRunner& jobs);

/// @brief Predicts the run on `num_ranks` ranks instead, and writes prediction.json. The folder's
/// mesh stays as it is.
/// @note Collective.
/// @return The prediction for people, several lines.
/// @throws what the stages throw, on every rank.
[[nodiscard]] std::string predict_case(const config::Case& given, const MeshOptions& options,
                                       int num_ranks, const comm::Communicator& comm,
                                       jobs::JobRunner& jobs);

}  // namespace tessera::pipeline
