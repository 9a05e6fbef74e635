// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief Coarse vertices, edges and triangles that are refined together, with local numbers and
/// their place in the skeleton. Vertices, and with them edges and triangles, keep the ascending
/// order of the coarse vertex numbers, so lattices of the same entity read the same everywhere.
struct Complex {
  std::vector<LocalIndex> vertex_coarse{};      ///< Shape (num_vertices); ascending.
  std::vector<LocalIndex> vertex_skeleton{};    ///< Skeleton vertex, or kNoIndex inside.
  std::vector<LocalIndex> edge_vertices{};      ///< Shape (num_edges, 2); local, ascending.
  std::vector<LocalIndex> edge_skeleton{};      ///< Skeleton edge, or kNoIndex inside.
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3); local, ascending.
  std::vector<LocalIndex> triangle_edges{};     ///< Shape (num_triangles, 3); sides 01, 02, 12.
  std::vector<LocalIndex> triangle_skeleton{};  ///< Skeleton triangle, or kNoIndex inside.

  [[nodiscard]] LocalIndex num_vertices() const { return count(vertex_coarse.size()); }
  [[nodiscard]] LocalIndex num_edges() const { return count(edge_skeleton.size()); }
  [[nodiscard]] LocalIndex num_triangles() const { return count(triangle_skeleton.size()); }

 private:
  static LocalIndex count(std::size_t size) { return static_cast<LocalIndex>(size); }
};

/// @brief Row of the edge or triangle with these local vertices, which ascend; kNoIndex: there is
/// none. Local; O(log n).
[[nodiscard]] LocalIndex find_edge(const Complex& complex, const std::array<LocalIndex, 2>& v);
[[nodiscard]] LocalIndex find_triangle(const Complex& complex, const std::array<LocalIndex, 3>& v);

/// @brief Some triangles of the skeleton, in the order given, with their edges and vertices. Local.
[[nodiscard]] Complex skeleton_complex(const Skeleton& skeleton,
                                       std::span<const LocalIndex> triangles);

/// @brief Some edges of the skeleton, ascending, with their vertices. Local.
[[nodiscard]] Complex edge_complex(const Skeleton& skeleton, std::span<const LocalIndex> edges);

/// @brief The skin of one subdomain: its skeleton triangles, in the order of
/// Skeleton::triangles_of(). Local.
[[nodiscard]] Complex skin_complex(const Skeleton& skeleton, LocalIndex subdomain);

/// @brief Some coarse tets with all their edges and triangles.
struct TetComplex {
  Complex faces{};                          ///< Triangles, edges and vertices of the tets.
  std::vector<LocalIndex> tets{};           ///< Shape (num_tets); coarse tets, as given.
  std::vector<LocalIndex> tet_triangles{};  ///< Shape (num_tets, 4); triangle opposite to corner c.
  std::vector<LocalIndex> tet_vertices{};   ///< Shape (num_tets, 4); local, the coarse tet's order.
};

/// @brief Edges of tet `tet` in the order of kTetEdgeCorners: rows of complex.faces. Local.
[[nodiscard]] std::array<LocalIndex, 6> edges_of_tet(const TetComplex& complex, LocalIndex tet);

/// @brief Builds the complex of the given coarse tets. Local; O(n log n) in their number.
[[nodiscard]] TetComplex tet_complex(const CoarseMesh& coarse, const Skeleton& skeleton,
                                     std::span<const LocalIndex> tets);

}  // namespace tessera::mesh
