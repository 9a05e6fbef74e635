// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace tessera::pipeline {

/// @brief How the program ends; the same on every rank. Scripts rely on the numbers.
enum class ExitCode : int {
  ok = 0,
  failed = 2,         ///< No valid mesh; `check`: does not conform.
  degraded = 3,       ///< A valid mesh is saved, but a target was missed or a kernel substituted.
  wrong_input = 64,   ///< Command line, case file or input file.
  internal = 70,      ///< A defect of the program.
  cannot_write = 73,  ///< Permission, disk full, folder in use.
  stopped = 75,       ///< By a signal, or a peer of this rank was lost.
};
[[nodiscard]] constexpr ExitCode last_value(ExitCode /*type*/) { return ExitCode::stopped; }

/// @brief The exit code an exception stands for.
[[nodiscard]] ExitCode exit_code_of(const std::exception& error);

/// @brief The code's name in report.json.
[[nodiscard]] std::string status_name(ExitCode code);

}  // namespace tessera::pipeline
