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

// An edge of the skeleton on a line inside of solids. All of these are there: a line lies on the
// sides of cells, and so between materials.
struct LineEdge {
  LocalIndex edge = kNoIndex;
  LocalIndex line = kNoIndex;  // Row of mesh::line_names().
};

// Ascending.
[[nodiscard]] std::vector<LineEdge> edges_on_lines(const mesh::Skeleton& skeleton,
                                                   const mesh::CoarseMesh& coarse);

// The points that n intervals put on an edge of the skeleton, from its first vertex to its second.
[[nodiscard]] std::vector<mesh::HostPoint> points_along(const mesh::Skeleton& skeleton,
                                                        const mesh::HostLayout& hosts,
                                                        LocalIndex edge, LocalIndex n);

// The subdomain that owns each of these edges: the lowest one that ends there at another material
// or outside. Its tet at such a triangle stays its own, whatever the improvement of seams
// exchanges. Shape (lines).
[[nodiscard]] std::vector<LocalIndex> owners_of(const std::vector<LineEdge>& lines,
                                                const mesh::Skeleton& skeleton,
                                                const mesh::Decomposition& decomposition);

// Gives a piece, as it was filled, the edges on lines that it owns.
void add_line_edges(const PartitionedMesh& cut, mesh::Piece& piece);

}  // namespace tessera::subdomain
