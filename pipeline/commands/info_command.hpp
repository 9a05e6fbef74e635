// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief `tessera info`: says what a CAD model, a case file or a mesh holds.
/// @note Collective.
/// @throws InputError on every rank if the file cannot be read.
[[nodiscard]] ExitCode run_info_command(const InfoCommand& command, const comm::Communicator& comm,
                                        jobs::JobRunner& jobs);

}  // namespace tessera::pipeline
