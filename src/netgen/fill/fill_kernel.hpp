// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "tessera/fill/kernel.hpp"

namespace tessera::netgen {

/// @brief NETGEN's volume mesher as a fill kernel.
[[nodiscard]] std::unique_ptr<fill::Kernel> make_netgen_kernel();

}  // namespace tessera::netgen
