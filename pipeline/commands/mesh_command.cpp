// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/mesh_command.hpp"

#include <cstdio>
#include <string>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/config/case.hpp"

#include "pipeline/run_case.hpp"

namespace tessera::pipeline {
namespace {

// Rank 0 reads the file; the others get the resolved text, so no rank can see another case.
config::Case read_case(const MeshCommand& command, const comm::Communicator& comm)
{
  const std::string text = on_root(comm, [&] {
    config::Case given = config::load_case(command.case_file, command.overrides);
    if (command.output) given.output.directory = *command.output;
    return config::to_toml(given);
  });
  return config::parse_case(text, command.case_file);
}

MeshOptions options_of(const MeshCommand& command)
{
  MeshOptions options{.case_name = command.case_file.filename().string(),
                      .only_subdomains = command.only_subdomains,
                      .verbosity = command.verbosity,
                      .progress = command.progress};
  if (command.overwrite) options.existing = io::ExistingFolder::overwrite;
  if (command.resume) options.existing = io::ExistingFolder::resume;
  return options;
}

}  // namespace

ExitCode run_mesh_command(const MeshCommand& command, const comm::Communicator& comm,
                          jobs::JobRunner& jobs)
{
  const config::Case given = read_case(command, comm);
  const MeshOptions options = options_of(command);
  if (command.dump_config) {
    if (comm.rank() == 0) std::fputs(config::to_toml(given).c_str(), stdout);
    return ExitCode::ok;
  }
  if (command.dry_run) {
    const std::string table =
        predict_case(given, options, command.predicted_ranks.value_or(comm.size()), comm, jobs);
    if (comm.rank() == 0 && command.verbosity != Verbosity::quiet)
      std::fputs(table.c_str(), stdout);
    return ExitCode::ok;
  }
  const MeshResult result = run_case(given, options, comm, jobs);
  return result.status == MeshStatus::ok ? ExitCode::ok : ExitCode::degraded;
}

}  // namespace tessera::pipeline
