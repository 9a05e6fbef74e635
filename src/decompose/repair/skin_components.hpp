// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/union_find.hpp"

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief Finds the closed surfaces that bound sets of tets.
class SkinComponents {
 public:
  explicit SkinComponents(const TetGraph& graph);

  /// @brief Tets with a triangle on each surface but the one with most triangles; empty if there is
  /// only one surface: then nothing is enclosed. Ascending; of the first enclosed surface only.
  /// @pre `tets` are all tets of one part, ascending. Two surfaces do not touch
  /// (NonManifoldVertices is zero).
  [[nodiscard]] std::vector<LocalIndex> tets_at_cavity(const TetPartition& partition,
                                                       std::span<const LocalIndex> tets);

 private:
  struct SkinTriangle {
    LocalIndex tet;
    LocalIndex vertex;
  };
  void collect(const TetPartition& partition, std::span<const LocalIndex> tets);

  const TetGraph* graph_;
  UnionFind surfaces_;                     // of the vertices; each by itself between calls
  std::vector<LocalIndex> num_triangles_;  // shape (num_vertices): at roots; 0 between calls
  std::vector<SkinTriangle> skin_{};
  std::vector<LocalIndex> touched_{};
};

}  // namespace tessera::decompose
