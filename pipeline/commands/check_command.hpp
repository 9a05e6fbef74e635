// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief `tessera check`: verifies a mesh from its files alone and prints what it finds.
/// @note Collective.
/// @return ok, or failed if the mesh does not conform.
/// @throws InputError on every rank if a file cannot be read.
[[nodiscard]] ExitCode run_check_command(const CheckCommand& command,
                                         const comm::Communicator& comm);

}  // namespace tessera::pipeline
