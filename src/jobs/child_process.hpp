// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <poll.h>
#include <sys/types.h>

#include "tessera/base/file_descriptor.hpp"

#include "jobs/packet.hpp"

/// What the worker processes do with themselves and with their children.
namespace tessera::jobs {

/// @brief Ends this process with its parent, however the parent ends. @pre called right after fork.
void die_with_parent(pid_t parent);

/// @brief Lets signals to the process group pass: Ctrl-C is for the rank, which decides.
void ignore_group_signals();

/// @brief Closes what was open at the fork, but for the standard streams and `keep`.
void close_all_but(std::span<const int> keep);

/// @brief A log to whose end processes write. Nothing if its name is empty or it cannot be opened.
[[nodiscard]] FileDescriptor open_log(const std::filesystem::path& file);

/// @brief Standard output and error go to `log`, or to /dev/null if that is nothing.
void redirect_output(const FileDescriptor& log);

/// @brief Cores on which a process may run.
inline constexpr std::size_t kMostCores = 8192;
using Cores = std::bitset<kMostCores>;

/// @brief Those of a process, 0 for this one; nothing if they cannot be told.
[[nodiscard]] std::optional<Cores> cores_of(pid_t process);

/// @brief Moves this process to some cores. @return Whether it may run on any of them.
bool move_to(const Cores& cores);

/// @brief Writes out what is buffered, so that a fork does not inherit it and _exit() not lose it.
void flush_streams();

/// @brief Tells when children end, as a file descriptor for poll(): blocks SIGCHLD.
class ChildWatch {
 public:
  ChildWatch();

  [[nodiscard]] int descriptor() const noexcept { return signals_.get(); }

  /// @brief Waits until a child may have ended or what is polled has something to tell.
  void wait(std::vector<pollfd> polled) const;

  /// @brief Reaps `child` if it has ended. @return How it did, or nothing if it still runs.
  [[nodiscard]] std::optional<ProcessEnd> reap(pid_t child) const;

 private:
  FileDescriptor signals_;
};

/// @brief Takes back what a ChildWatch blocks, in a child that is not to inherit it.
void unblock_signals();

}  // namespace tessera::jobs
