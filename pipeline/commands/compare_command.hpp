// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

/// @brief Writes a page with two runs side by side, and prints the figures.
/// @note Collective.
/// @throws InputError if a folder is not that of a run, OutputError if the page cannot be written;
/// on every rank.
[[nodiscard]] ExitCode run_compare_command(const CompareCommand& command,
                                           const comm::Communicator& comm);

}  // namespace tessera::pipeline
