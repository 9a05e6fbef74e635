// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::testing {

/// @brief kuhn_cube(4) without a wedge whose sharp edge is x = z = 1/2, and which is `thickness`
/// thick at x = 0. Its upper side is patch 6, its lower one patch 7, and its edge curve 12.
[[nodiscard]] mesh::CoarseMesh wedge_cube(double thickness);

}  // namespace tessera::testing
