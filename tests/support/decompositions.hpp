// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::testing {

/// @brief Cuts every material into `slabs_a_material` slabs of equal height along y, by the tets'
/// middles; subdomains are numbered material by material. Without the graph.
/// @pre the mesh is a cube of tests/support/meshes.hpp whose n is a multiple of slabs_a_material.
[[nodiscard]] mesh::Decomposition slabs(const mesh::CoarseMesh& coarse, int slabs_a_material);

/// @brief Cuts the unit cube into its eight octants by the tets' middles, numbered x, y, z (x
/// fastest). Without the graph. @pre a cube of tests/support/meshes.hpp with an even n.
[[nodiscard]] mesh::Decomposition octants(const mesh::CoarseMesh& coarse);

/// @brief Every material is one subdomain. Without the graph.
[[nodiscard]] mesh::Decomposition one_subdomain_a_material(const mesh::CoarseMesh& coarse);

}  // namespace tessera::testing
