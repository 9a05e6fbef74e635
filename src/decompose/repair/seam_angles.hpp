// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/decomposition.hpp"

#include "decompose/partition/tet_graph.hpp"

namespace tessera::decompose {

/// @brief Whether the triangle lies between two subdomains of one material.
[[nodiscard]] bool is_seam(const TetGraph& graph, const mesh::Decomposition& decomposition,
                           const mesh::TriangleTets& triangle);

/// @brief Smallest dihedral angle, inside a subdomain, between a seam triangle and the next skin
/// triangle: a small one becomes a wedge that no filler can fill well. 180 without seams.
/// @pre Skins are manifold.
[[nodiscard]] double min_seam_dihedral_deg(const TetGraph& graph,
                                           const mesh::Decomposition& decomposition);

}  // namespace tessera::decompose
