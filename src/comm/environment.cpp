// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/environment.hpp"

namespace tessera::comm {

Environment::Environment(int& argc, char**& argv) { MPI_Init(&argc, &argv); }

Environment::~Environment() { MPI_Finalize(); }

Communicator world() { return Communicator(MPI_COMM_WORLD); }

}  // namespace tessera::comm
