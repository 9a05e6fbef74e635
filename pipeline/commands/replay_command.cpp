// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/replay_command.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/replaceable_parts.hpp"

namespace tessera::pipeline {
namespace {

ExitCode replay(const RecordedJob& job)
{
  fmt::print("replay of {}: {} loads\n", job.name, job.loads.size());
  std::fflush(stdout);
  const auto worker = replaceable_parts().make_worker();
  try {
    for (const Bytes& load : job.loads) worker->load(load);
    const Bytes result = worker->run(job.request);
    fmt::print("{}: succeeded, {} bytes\n", job.name, result.size());
    return ExitCode::ok;
  } catch (const Error& error) {
    fmt::print("{}: failed: {}\n", job.name, error.what());
    return ExitCode::failed;
  }
}

}  // namespace

ExitCode run_replay_command(const ReplayCommand& command, const comm::Communicator& comm)
{
  return on_root(comm, [&] { return replay(read_failed_job(command.folder)); });
}

}  // namespace tessera::pipeline
