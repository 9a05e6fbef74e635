// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/quadratic_tet.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

#include "check/findings.hpp"
#include "check/piece/mesh.hpp"

/// What cells of second order have besides corners: a node on every edge.
namespace tessera::check {

/// @brief Takes the nodes out of cells of second order, which then are of first order. Local.
/// @return Shape (num_cells, 6 or 3), in the order of VTK; empty if the cells have none.
[[nodiscard]] std::vector<LocalIndex> take_nodes(mesh::MeshArrays& arrays);

/// @brief Numbers the nodes of a piece as its vertices are, and leaves out cells with nodes that
/// are out of range or not different. Reported: these, edges of several nodes, nodes of several
/// edges, and nodes that are corners as well. Local; O(n log n).
/// @param[in] vertex_of The vertex of each point. @param[in,out] is_used Points of cells.
void set_nodes(PieceMesh& mesh, std::span<const LocalIndex> vertex_of, std::vector<bool>& is_used,
               Findings& findings);

/// @brief Calls visit(vertex) for every corner and node of the cells that are not left out, more
/// than once. Local.
template <class Visit>
void for_each_used_vertex(const PieceMesh& mesh, Visit&& visit)
{
  const std::size_t num_nodes = mesh.is_of_second_order() ? (mesh.name.is_boundary ? 3 : 6) : 0;
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    for (const LocalIndex v : mesh.cell(c)) visit(v);
    for (std::size_t e = 0; e < num_nodes; ++e) {
      visit(mesh.cell_nodes[num_nodes * static_cast<std::size_t>(c) + e]);
    }
  }
}

/// @brief The node of a cell between two of its vertices. Local. @pre it has nodes.
[[nodiscard]] LocalIndex node_between(const PieceMesh& mesh, LocalIndex cell, LocalIndex a,
                                      LocalIndex b);

/// @brief Positions of a tet's nodes. Local. @pre it has nodes.
[[nodiscard]] QuadraticTet node_positions(const PieceMesh& mesh, LocalIndex cell);

}  // namespace tessera::check
