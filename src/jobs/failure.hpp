// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/jobs/job_runner.hpp"

namespace tessera::jobs {

/// @brief The end of work that throws the exception that is being handled: failed, or out_of_memory
/// for std::bad_alloc. @pre called inside a catch block.
[[nodiscard]] JobEnd current_failure();

}  // namespace tessera::jobs
