// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/version.hpp"

namespace tessera {

std::string_view version() noexcept { return TESSERA_VERSION; }

}  // namespace tessera
