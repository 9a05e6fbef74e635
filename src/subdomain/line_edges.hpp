// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"

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

// Gives a piece, as it was filled, the edges on lines that it owns: it is the lowest subdomain that
// holds them.
void add_line_edges(const mesh::Skeleton& skeleton, const mesh::CoarseMesh& coarse,
                    mesh::Piece& piece);

}  // namespace tessera::subdomain
