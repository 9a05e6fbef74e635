// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/tessera.hpp"

namespace tessera::testing {

/// @brief That of the program, which its main() has made before MPI_Init: job processes are forked
/// then.
[[nodiscard]] Session& session_of_this_process();

}  // namespace tessera::testing
