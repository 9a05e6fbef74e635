// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::topology {

/// @brief Adds a patch on the same surface, with the name and row of another one; returns it. It
/// has no faces, is no image and has no layers. Local.
[[nodiscard]] LocalIndex add_patch(mesh::CoarseMesh& mesh, LocalIndex like);

}  // namespace tessera::topology
