// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief `tessera repartition`: reads a mesh, cuts it into balanced parts, moves every part to one
/// rank and writes a piece for each.
/// @note Collective.
/// @return ok, or degraded if a part is larger or less connected than promised.
/// @throws InputError, OutputError, MeshError or Interrupted on every rank.
[[nodiscard]] ExitCode run_repartition_command(const RepartitionCommand& command,
                                               const comm::Communicator& comm);

}  // namespace tessera::pipeline
