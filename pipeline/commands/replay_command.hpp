// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief Runs one kept job again, in the process of rank 0 itself and without any limit. So a
/// debugger sees it, and a crash of the job is a crash of the program. Writes nothing into the
/// run's folder.
/// @return ok if the job succeeds, failed if it fails as a job does.
/// @note Collective.
/// @throws InputError on every rank if the job cannot be read.
ExitCode run_replay_command(const ReplayCommand& command, const comm::Communicator& comm);

}  // namespace tessera::pipeline
