// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::mesh {

/// @brief The coarse tets of every subdomain, ascending. Local; linear.
[[nodiscard]] IndexLists subdomain_tets(const Decomposition& decomposition);

}  // namespace tessera::mesh
