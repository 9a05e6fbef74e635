// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace tessera::comm {

/// @brief The MPI library's name and version, e.g. "Open MPI 4.1.4". Local; needs no MPI_Init.
[[nodiscard]] std::string mpi_version();

}  // namespace tessera::comm
