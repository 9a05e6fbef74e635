// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief MPI from its construction to its end; one in a program, in main(). After a roll call that
/// has failed, it ends the processes of all ranks and says why: MPI cannot end in order without the
/// missing one.
class Environment {
 public:
  Environment(int& argc, char**& argv);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

/// @brief Whether MPI was ever started in this process, also if it has ended. Local.
[[nodiscard]] bool was_mpi_started();

/// @brief A communicator of all ranks. @note Collective. @pre an Environment lives.
[[nodiscard]] Communicator world();

}  // namespace tessera::comm
