// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief The tets of each face. Shape (num_faces). Local; O(n log n).
/// @param[in] triangles triangles_of_tets() of the mesh. @pre Every face is one of them.
[[nodiscard]] std::vector<TriangleTets> tets_of_faces(const CoarseMesh& mesh,
                                                      std::span<const TriangleTets> triangles);

/// @brief The same for who needs no other triangles.
[[nodiscard]] std::vector<TriangleTets> tets_of_faces(const CoarseMesh& mesh);

}  // namespace tessera::mesh
