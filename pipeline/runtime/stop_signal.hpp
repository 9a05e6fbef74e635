// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::pipeline {

/// @brief From now on SIGINT, SIGTERM and SIGUSR1 (a batch system's warning) only set a flag; a
/// second SIGINT ends the process at once.
void catch_stop_signals();

/// @brief From now on a write fails with an error, as on a full disk, where it would have ended the
/// process. That is for a file that grows beyond the limit of the user, and a pipe that nobody
/// reads. A handler of the program stays. Processes forked later inherit it.
void ignore_write_signals();

/// @brief Whether one of them has come to this rank. Local, cheap.
[[nodiscard]] bool stop_requested();

/// @brief What a run says that one of them has ended.
inline constexpr const char* kStopped = "stopped by a signal";

/// @brief Throws Interrupted if so. Local: within what all_or_none() runs, or the like.
void throw_if_stop_requested();

}  // namespace tessera::pipeline
