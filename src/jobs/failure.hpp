// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "tessera/base/bytes.hpp"
#include "tessera/jobs/job_runner.hpp"

namespace tessera::jobs {

/// @brief Work that came to an orderly end without a result.
struct Failure {
  JobStatus status = JobStatus::failed;  ///< failed, or out_of_memory for std::bad_alloc.
  ErrorKind error = ErrorKind::other;
  std::string message{};
};

/// @brief What the exception says that is being handled. @pre called inside a catch block.
[[nodiscard]] Failure current_failure();

[[nodiscard]] Bytes to_bytes(const Failure& failure);
[[nodiscard]] Failure to_failure(std::span<const std::byte> bytes);

}  // namespace tessera::jobs
