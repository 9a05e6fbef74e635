// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <dlfcn.h>
#include <meshing.hpp>

#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {

std::string netgen_version()
{
  // NETGEN tells its version only to programs that register it; its library file is named by it.
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&::netgen::MeshVolume), &info) == 0) return "unknown";
  std::error_code error;
  const std::string file = std::filesystem::canonical(info.dli_fname, error).filename().string();
  const auto at = file.find(".so.");
  return error || at == std::string::npos ? "unknown" : file.substr(at + 4);
}

}  // namespace tessera::netgen
