// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/exit_code.hpp"

#include "tessera/base/error.hpp"

namespace tessera::pipeline {

ExitCode exit_code_of(const std::exception& error)
{
  switch (kind_of(error)) {
    case ErrorKind::config:
    case ErrorKind::input:
    case ErrorKind::geometry:
      return ExitCode::wrong_input;
    case ErrorKind::mesh:
    case ErrorKind::netgen:
      return ExitCode::failed;
    case ErrorKind::output:
      return ExitCode::cannot_write;
    case ErrorKind::interrupted:
      return ExitCode::stopped;
    case ErrorKind::usage:
    case ErrorKind::other:
      break;
  }
  return ExitCode::internal;
}

std::string status_name(ExitCode code)
{
  switch (code) {
    case ExitCode::ok:
      return "ok";
    case ExitCode::degraded:
      return "degraded";
    case ExitCode::stopped:
      return "stopped";
    default:
      return "failed";
  }
}

}  // namespace tessera::pipeline
