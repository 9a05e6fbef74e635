// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief The tets of each face. Shape (num_faces). Local; O(n log n). @pre Every face is one of a
/// tet.
[[nodiscard]] std::vector<TriangleTets> tets_of_faces(const CoarseMesh& mesh);

}  // namespace tessera::mesh
