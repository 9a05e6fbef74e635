// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/exit_code.hpp"

#include <filesystem>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {

ExitCode exit_code_of(const std::exception& error)
{
  const auto is = [&error]<class E>(const E*) { return dynamic_cast<const E*>(&error) != nullptr; };
  if (is(static_cast<const ConfigError*>(nullptr))) return ExitCode::wrong_input;
  if (is(static_cast<const InputError*>(nullptr))) return ExitCode::wrong_input;
  if (is(static_cast<const MeshError*>(nullptr))) return ExitCode::failed;
  if (is(static_cast<const OutputError*>(nullptr))) return ExitCode::cannot_write;
  // Thrown where folders are made: permission, disk full.
  if (is(static_cast<const std::filesystem::filesystem_error*>(nullptr))) {
    return ExitCode::cannot_write;
  }
  if (is(static_cast<const Interrupted*>(nullptr))) return ExitCode::stopped;
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

void throw_on_all_ranks(ExitCode code, const std::string& message)
{
  switch (code) {
    case ExitCode::wrong_input:
      throw comm::Collective<InputError>(message);
    case ExitCode::failed:
      throw comm::Collective<MeshError>(message);
    case ExitCode::cannot_write:
      throw comm::Collective<OutputError>(message);
    case ExitCode::stopped:
      throw comm::Collective<Interrupted>(message);
    default:
      throw comm::Collective<Error>(message);
  }
}

}  // namespace tessera::pipeline
