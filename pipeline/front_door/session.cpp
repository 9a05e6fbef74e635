// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/front_door/session.hpp"

#include <optional>

#include "tessera/base/error.hpp"
#include "tessera/comm/environment.hpp"
#include "tessera/tessera.hpp"

#include "pipeline/jobs/replaceable_parts.hpp"
#include "pipeline/runtime/stop_signal.hpp"

namespace tessera {
namespace {

jobs::JobRunner* only_runner = nullptr;

// Before anything is forked. MPI must not be in the processes that jobs are forked from.
void require_first()
{
  if (only_runner != nullptr) throw UsageError("there is a tessera::Session already");
  if (!comm::was_mpi_started()) return;
  throw UsageError(
      "a tessera::Session must be constructed before MPI_Init: it forks the processes in which "
      "NETGEN runs. Construct it first in main(); tessera::Session() leaves MPI_Init to you");
}

}  // namespace

struct Session::State {
  std::optional<jobs::JobRunner> jobs{};
  std::optional<comm::Environment> mpi{};  // Ends before the jobs.

  State()
  {
    require_first();
    pipeline::ignore_write_signals();
    jobs.emplace(pipeline::replaceable_parts().make_worker);
    only_runner = &*jobs;
  }

  ~State() { only_runner = nullptr; }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Session::Session() : state_(std::make_unique<State>()) {}

Session::Session(int& argc, char**& argv) : Session() { state_->mpi.emplace(argc, argv); }

Session::~Session() = default;

comm::Communicator Session::world(double rank_timeout_s) const
{
  comm::roll_call(MPI_COMM_WORLD, "Session::world()", rank_timeout_s);
  return comm::Communicator(MPI_COMM_WORLD);
}

void Session::catch_stop_signals() const { pipeline::catch_stop_signals(); }

namespace pipeline {

jobs::JobRunner* session_jobs() { return only_runner; }

}  // namespace pipeline
}  // namespace tessera
