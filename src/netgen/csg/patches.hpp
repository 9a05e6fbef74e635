// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "netgen/mesh_conversion.hpp"

/// What a patch of a CSG model is, and how patches are numbered, whatever has made the surface.
namespace tessera::netgen {

/// @brief The patch where a surface is between two solids (from 1), or outside (0) of one.
[[nodiscard]] PatchKey key_of_patch(LocalIndex surface, LocalIndex solid, LocalIndex other);

/// @brief Gives every connected piece of a patch a patch of its own, with the same name. Local.
void separate_patches(mesh::CoarseMesh& mesh);

}  // namespace tessera::netgen
