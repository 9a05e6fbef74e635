// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/jobs/job_runner.hpp"

namespace tessera::jobs {

/// @brief How a program ended that was run by run_program().
struct ProgramOutcome {
  JobStatus status = JobStatus::ok;  ///< ok, crashed, exited, or the limit that it broke.
  int code = 0;                      ///< Its exit status, or the signal that ended it.
  bool is_missing = false;           ///< There is no program of that name.
};

/// @brief Runs a program of this machine to its end, from within a job. It ends with the calling
/// process, however that ends, and ignores what that ignores (Ctrl-C).
/// @param[in] arguments The program, which is looked for on the PATH, and its arguments.
/// @param[in] folder Its working directory.
/// @param[in] log_file Gets its standard output and error.
/// @note Local. The caller counts as awake meanwhile, if the program is not stalled.
[[nodiscard]] ProgramOutcome run_program(const std::vector<std::string>& arguments,
                                         const std::filesystem::path& folder,
                                         const std::filesystem::path& log_file,
                                         const JobLimits& limits);

/// @brief Whether run_program() would find a program of this name. Local.
[[nodiscard]] bool is_on_path(const std::string& name);

}  // namespace tessera::jobs
