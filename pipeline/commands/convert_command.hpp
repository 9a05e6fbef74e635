// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief `tessera convert`: writes a mesh that is in files in other formats.
/// @note Collective.
/// @throws ConfigError, InputError, OutputError or Interrupted on every rank.
[[nodiscard]] ExitCode run_convert_command(const ConvertCommand& command,
                                           const comm::Communicator& comm);

}  // namespace tessera::pipeline
