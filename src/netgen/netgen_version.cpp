// SPDX-License-Identifier: BSD-3-Clause
#include <core/ngcore.hpp>

#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {

std::string netgen_version()
{
  const std::string version = ngcore::GetLibraryVersion("netgen").to_string();
  return version.starts_with('v') ? version.substr(1) : version;
}

}  // namespace tessera::netgen
