// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "tessera/jobs/job_runner.hpp"

namespace tessera::pipeline {

/// @brief The program: starts a Session, runs the command, and turns errors into exit codes.
/// @param[in] prepare Called on every rank before the command is read. What it throws ends the
/// program as an error of the command line does.
/// @note Collective over all ranks; once.
[[nodiscard]] int tessera_main(
    int argc, char** argv,
    const std::function<void(jobs::JobRunner&)>& prepare = [](jobs::JobRunner&) {});

}  // namespace tessera::pipeline
