// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/union_find.hpp"

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief Where skins are not manifold: counts these places, and answers what a move would change.
///
/// At each vertex of a part's skin a graph is looked at. Its edges are the skin triangles there,
/// and its nodes are the other end points. Where the skin is manifold, the graph is one simple
/// cycle. The count of a vertex is (edges - nodes) + (components - 1), which is then 0. An edge
/// with four triangles adds 1 at either end, a second fan adds 1. adds 1.
class NonManifoldVertices {
 public:
  NonManifoldVertices(const TetGraph& graph, const TetPartition& partition);

  /// @brief The counts of all parts at this vertex, summed, as of its last refresh.
  [[nodiscard]] int total(LocalIndex v) const { return total_[static_cast<std::size_t>(v)]; }
  /// @brief The count of one part at this vertex, computed now.
  [[nodiscard]] int count(LocalIndex v, LocalIndex part);
  /// @brief The counts of two parts at the four vertices of a tet, summed, computed now.
  [[nodiscard]] int count_at_tet(LocalIndex t, LocalIndex part, LocalIndex other_part);
  /// @brief Recomputes total() at the vertices of these tets.
  void refresh(std::span<const LocalIndex> tets);
  /// @brief Parts of the tets at a vertex, ascending; valid until the next call.
  [[nodiscard]] std::span<const LocalIndex> parts_at(LocalIndex v);
  /// @brief A vertex that is joined to `v` by an edge with four skin triangles; kNoIndex if none.
  [[nodiscard]] LocalIndex pinched_edge(LocalIndex v, LocalIndex part);

 private:
  struct LinkEdge {
    LocalIndex a;
    LocalIndex b;
  };
  void collect_link(LocalIndex v, LocalIndex part);
  [[nodiscard]] LocalIndex node_of(LocalIndex vertex);
  void compute_total(LocalIndex v);

  const TetGraph* graph_;
  const TetPartition* partition_;
  std::vector<int> total_;              // shape (num_vertices)
  std::vector<LinkEdge> link_{};        // skin triangles at the vertex in question
  std::vector<LocalIndex> node_;        // shape (num_vertices); kNoIndex between calls
  std::vector<LocalIndex> vertices_{};  // of the nodes
  UnionFind components_{};              // of the nodes
  std::vector<LocalIndex> parts_{};
  std::vector<LocalIndex> stale_{};
};

}  // namespace tessera::decompose
