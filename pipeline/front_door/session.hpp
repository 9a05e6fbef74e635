// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/jobs/job_runner.hpp"

namespace tessera::pipeline {

/// @brief The job processes of this process's Session; nullptr without one. Local.
[[nodiscard]] jobs::JobRunner* session_jobs();

}  // namespace tessera::pipeline
