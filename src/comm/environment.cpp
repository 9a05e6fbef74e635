// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/environment.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tessera/base/held_signals.hpp"
#include "tessera/comm/roll_call.hpp"

namespace tessera::comm {
namespace {

// The rank that is missing may wait for this one, somewhere else: then MPI_Finalize never returns.
[[noreturn]] void end_without(const FailedRollCall& failed)
{
  constexpr std::chrono::seconds kUntilOthersSpeak{2};
  // One speaks for all and ends them, unless that rank does not come here.
  if (!failed.is_speaker) std::this_thread::sleep_for(kUntilOthersSpeak);
  std::fprintf(stderr, "tessera: %s\n", failed.message.c_str());
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  std::abort();  // MPI_Abort does not return, but is not declared so.
}

}  // namespace

// Other threads than the main one work too, but do not communicate. Those of MPI get none of the
// signals that ask a program to stop: whoever holds one back holds it back for the whole process.
Environment::Environment(int& argc, char**& argv)
{
  const HeldSignals held{SIGINT, SIGTERM, SIGUSR1};
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

Environment::~Environment()
{
  if (failed_roll_call()) end_without(*failed_roll_call());
  MPI_Finalize();
}

bool was_mpi_started()
{
  int is_started = 0;
  MPI_Initialized(&is_started);
  return is_started != 0;
}

Communicator world() { return Communicator(MPI_COMM_WORLD); }

}  // namespace tessera::comm
