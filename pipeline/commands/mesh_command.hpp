// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief `tessera mesh`: from a case file to an output folder.
/// @note Collective.
/// @return ok or degraded; a run that fails throws, on every rank, after its report is written.
[[nodiscard]] ExitCode run_mesh_command(const MeshCommand& command, const comm::Communicator& comm,
                                        jobs::JobRunner& jobs);

}  // namespace tessera::pipeline
