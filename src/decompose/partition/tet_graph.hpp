// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/decompose/graph.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::decompose {

/// @brief The coarse mesh as the stages of the decomposition see it. The mesh must outlive it.
///
/// Only tets of one material are neighbours: to a subdomain, another material is the outside.
struct TetGraph {
  const mesh::CoarseMesh* mesh = nullptr;
  std::span<const double> tet_weight{};         ///< Shape (num_tets).
  std::vector<mesh::TriangleTets> triangles{};  ///< All triangles of the mesh.
  std::vector<LocalIndex> tet_neighbours{};    ///< Shape (num_tets, 4), beyond face i; or kNoIndex.
  std::vector<std::int32_t> tet_face_cost{};   ///< Shape (num_tets, 4): price as a seam triangle.
  std::vector<std::int32_t> tet_int_weight{};  ///< Shape (num_tets): tet_weight, quantised.
  IndexLists vertex_tets{};                    ///< Tets at each vertex, ascending.

  [[nodiscard]] LocalIndex num_tets() const { return mesh->num_tets(); }
  [[nodiscard]] LocalIndex num_vertices() const { return mesh->num_vertices(); }
  [[nodiscard]] double weight(LocalIndex t) const
  {
    return tet_weight[static_cast<std::size_t>(t)];
  }
  [[nodiscard]] std::span<const LocalIndex, 4> vertices(LocalIndex t) const { return mesh->tet(t); }
  [[nodiscard]] std::span<const LocalIndex, 4> neighbours(LocalIndex t) const
  {
    return std::span<const LocalIndex, 4>(tet_neighbours.data() + 4 * static_cast<std::size_t>(t),
                                          4);
  }
  [[nodiscard]] std::span<const std::int32_t, 4> face_cost(LocalIndex t) const
  {
    return std::span<const std::int32_t, 4>(tet_face_cost.data() + 4 * static_cast<std::size_t>(t),
                                            4);
  }
  [[nodiscard]] std::span<const LocalIndex> tets_at(LocalIndex v) const { return vertex_tets[v]; }
};

[[nodiscard]] TetGraph make_tet_graph(const mesh::CoarseMesh& mesh,
                                      std::span<const double> tet_weight);

/// @brief Area of a triangle of the mesh, output length unit squared.
[[nodiscard]] double triangle_area(const mesh::CoarseMesh& mesh,
                                   const mesh::TriangleTets& triangle);

/// @brief The mean of a tet's vertices.
[[nodiscard]] Vec3 centroid_of(const mesh::CoarseMesh& mesh, LocalIndex t);

/// @brief Positive integers in the ratio of the values, as exact as a Graph allows. @pre values >
/// 0.
[[nodiscard]] std::vector<std::int32_t> quantise(std::span<const double> values);

/// @brief The dual graph of some tets; vertex i of it is tets[i].
/// @param[in,out] local_index Shape (num_tets), all kNoIndex; scratch, left as it was.
[[nodiscard]] Graph dual_graph(const TetGraph& graph, std::span<const LocalIndex> tets,
                               std::vector<LocalIndex>& local_index);

}  // namespace tessera::decompose
