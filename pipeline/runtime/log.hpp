// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include <spdlog/logger.h>

#include "tessera/tessera.hpp"

namespace tessera::pipeline {

/// @brief The log of a run: plain lines on standard output (warnings and errors marked), and all
/// with times in `file`. An empty path makes a silent log: only rank 0 speaks.
/// Messages are formatted by fmt::format(), which is compiled in its library: what spdlog formats
/// by itself is compiled anew in each source, and took 8 of the 11 s of a small one.
/// @throws OutputError if the file cannot be written.
[[nodiscard]] std::shared_ptr<spdlog::logger> make_log(const std::filesystem::path& file,
                                                       Verbosity verbosity);

}  // namespace tessera::pipeline
