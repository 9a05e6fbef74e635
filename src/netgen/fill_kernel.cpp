// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {
std::unique_ptr<fill::Kernel> make_fill_kernel() { return nullptr; }
}  // namespace tessera::netgen
