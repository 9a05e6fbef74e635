// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace tessera::jobs {

/// @brief Largest resident memory of the calling process since it started, bytes. Local.
///
/// A rank with its jobs used at most this plus JobRunner::peak_rss_bytes().
[[nodiscard]] std::size_t peak_rss_of_this_process();

/// @brief CPU time of all threads of the calling process since it started, seconds. Local.
[[nodiscard]] double cpu_time_of_this_process();

}  // namespace tessera::jobs
