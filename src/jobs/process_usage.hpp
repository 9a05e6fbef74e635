// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include <sys/types.h>

namespace tessera::jobs {

/// @brief What a process uses at this moment, as the kernel tells it.
struct ProcessSample {
  double cpu_s = 0.0;         ///< CPU time of all its threads so far, seconds; steps of 10 ms.
  std::size_t rss_bytes = 0;  ///< Resident memory; pages shared with others count in full.
  bool runnable = false;      ///< Runs, or would if a core were free: no sleeper.
};

/// @brief Nothing if there is no such process (any more).
[[nodiscard]] std::optional<ProcessSample> sample_process(pid_t pid);

/// @brief Resident memory of a process, bytes; a page that n processes share counts 1/n. Walks the
/// page tables: 30 ms for a GiB. 0 if there is no such process.
[[nodiscard]] std::size_t proportional_rss_bytes(pid_t pid);

/// @brief Resident memory that the calling process shares with no other, bytes. Walks the page
/// tables, too.
[[nodiscard]] std::size_t private_rss_bytes();

/// @brief Largest resident memory of a process so far, bytes. 0 if there is no such process.
[[nodiscard]] std::size_t peak_rss_bytes(pid_t pid);

}  // namespace tessera::jobs
