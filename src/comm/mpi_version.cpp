// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/mpi_version.hpp"

#include <algorithm>
#include <array>

#include <mpi.h>

namespace tessera::comm {

std::string mpi_version()
{
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  std::string version(text.data(), static_cast<std::size_t>(length));
  // "Open MPI v4.1.4, package: …": the name and the number are enough.
  version.resize(std::min(version.size(), version.find_first_of(",\n")));
  if (const auto v = version.find(" v"); v != std::string::npos) version.erase(v + 1, 1);
  return version;
}

}  // namespace tessera::comm
