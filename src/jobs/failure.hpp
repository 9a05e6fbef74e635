// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>

#include "tessera/jobs/job_runner.hpp"

namespace tessera::jobs {

/// @brief Work that came to an orderly end without a result.
struct Failure {
  JobStatus status = JobStatus::failed;  ///< failed, or out_of_memory for std::bad_alloc.
  ErrorKind error = ErrorKind::other;
  std::string message{};

  static auto fields(auto& self) { return std::tie(self.status, self.error, self.message); }
};

/// @brief What the exception says that is being handled. @pre called inside a catch block.
[[nodiscard]] Failure current_failure();

}  // namespace tessera::jobs
