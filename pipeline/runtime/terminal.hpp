// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::pipeline {

/// @brief Whether what this process prints ends on a terminal. Under Open MPI's mpirun a rank
/// always writes to a pseudo-terminal, whose text mpirun hands on; then the standard output of
/// mpirun decides. If that cannot be seen (it runs on another host), the answer is no. Local.
[[nodiscard]] bool output_ends_on_terminal();

}  // namespace tessera::pipeline
