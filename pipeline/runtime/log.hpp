// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include <spdlog/logger.h>

#include "tessera/tessera.hpp"

namespace tessera::pipeline {

/// @brief The log of a run: plain lines on standard output (warnings and errors marked), and all
/// with times in `file`. An empty path makes a silent log: only rank 0 speaks.
/// @throws OutputError if the file cannot be written.
[[nodiscard]] std::shared_ptr<spdlog::logger> make_log(const std::filesystem::path& file,
                                                       Verbosity verbosity);

}  // namespace tessera::pipeline
