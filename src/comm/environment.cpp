// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/environment.hpp"

#include "tessera/base/held_signals.hpp"

namespace tessera::comm {

// Other threads than the main one work too, but do not communicate. Those of MPI get none of the
// signals that ask a program to stop: whoever holds one back holds it back for the whole process.
Environment::Environment(int& argc, char**& argv)
{
  const HeldSignals held{SIGINT, SIGTERM, SIGUSR1};
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

Environment::~Environment() { MPI_Finalize(); }

bool was_mpi_started()
{
  int is_started = 0;
  MPI_Initialized(&is_started);
  return is_started != 0;
}

Communicator world() { return Communicator(MPI_COMM_WORLD); }

}  // namespace tessera::comm
