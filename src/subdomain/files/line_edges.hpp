// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

namespace tessera::subdomain {

// PartitionedMesh::lines.
[[nodiscard]] std::vector<LineEdge> edges_on_lines(const mesh::CoarseMesh& coarse,
                                                   const mesh::Skeleton& skeleton,
                                                   const mesh::Decomposition& decomposition);

// The points that n intervals put on an edge of the skeleton, from its first vertex to its second.
[[nodiscard]] std::vector<mesh::HostPoint> points_along(const mesh::Skeleton& skeleton,
                                                        const mesh::HostLayout& hosts,
                                                        LocalIndex edge, LocalIndex n);

// Gives a piece, as it was filled, the edges on lines that it owns.
void add_line_edges(const PartitionedMesh& cut, mesh::Piece& piece);

}  // namespace tessera::subdomain
