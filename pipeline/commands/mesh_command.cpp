// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/mesh_command.hpp"

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/config/case.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/run_case.hpp"

namespace tessera::pipeline {
namespace {

// What the options of a model say, as a case file that stood beside the model would.
config::Case case_of_model(const MeshCommand& command)
{
  const std::filesystem::path& file = command.file;
  if (file.extension() == ".toml") {
    throw ConfigError(fmt::format(
        "{} is a case file: --size, --parts and --kernel are for a CAD model; in a case, --set "
        "size.target, --set output.parts and --set fill.kernel do the same",
        file.string()));
  }
  netgen::require_model_file(file);
  config::Case made;
  made.geometry.file = absolute(file);
  made.size.target = command.model->size;
  made.output.parts = command.model->parts;
  made.fill.kernel = command.model->kernel.value_or(made.fill.kernel);
  return config::parse_case(config::to_toml(made), file, command.overrides);
}

config::Case case_in(const MeshCommand& command)
{
  if (command.model) return case_of_model(command);
  if (!netgen::is_model_name(command.file)) {
    return config::load_case(command.file, command.overrides);
  }
  throw ConfigError(fmt::format(
      "{0} is a CAD model, so its mesh needs --size H, the wanted edge length; `tessera info {0}` "
      "suggests some",
      command.file.string()));
}

// Rank 0 reads the file; the others get the resolved text, so no rank can see another case.
config::Case read_case(const MeshCommand& command, const comm::Communicator& comm)
{
  const std::string text = on_root(comm, [&] {
    config::Case given = case_in(command);
    if (command.output) given.output.directory = *command.output;
    return config::to_toml(given);
  });
  return config::parse_case(text, command.file);
}

MeshOptions options_of(const MeshCommand& command)
{
  MeshOptions options{.case_name = command.file.filename().string(),
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
