// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/version.hpp"

namespace tessera {

std::string_view version() noexcept { return TESSERA_VERSION; }

std::string record_version(std::string_view library)
{
  return std::string(library) + ", records 26";
}

}  // namespace tessera
