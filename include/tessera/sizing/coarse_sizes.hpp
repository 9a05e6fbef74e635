// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/size_points.hpp"
#include "tessera/sizing/size_field.hpp"

namespace tessera::sizing {

/// @brief Lengths in wanted ones.
struct EdgeLengths {
  double coarse_edge = 0.0;   ///< Of the edges of a finer coarse mesh, > 0.
  double longest_part = 0.0;  ///< Up to which the parts of an edge may be left as they are, > 0.
};

/// @brief Where a coarse mesh should be finer. An edge is split into parts of one length, so where
/// the size falls steeply along a long one its parts are too long at one end, and a small region
/// between edges gets none.
///
/// Tets are cut into eight in bulk rounds until none is longer than coarse edges shall be. A size
/// that grows with the distance cannot fall faster either, so a region inside of a tet is found by
/// the size at its middle.
/// @param[in] levels Of the edges of `coarse`.
/// @return Points in tets that are too long, each with the length wanted of coarse edges there;
/// none if in no tet an edge has parts longer than `in_sizes.longest_part` sizes somewhere in the
/// tet. Local; a pure function of its arguments.
[[nodiscard]] mesh::SizePoints coarse_size_points(const mesh::CoarseMesh& coarse,
                                                  const mesh::EdgeLevels& levels,
                                                  const SizeField& sizes,
                                                  const EdgeLengths& in_sizes);

/// @brief How long the parts of an edge are where they are too long by most.
struct PartInSizes {
  double in_sizes = 0.0;  ///< Length over `size`.
  double size = 0.0;      ///< Wanted there.
  Vec3 place{};

  static auto fields(auto& self) { return std::tie(self.in_sizes, self.size, self.place); }
};

/// @brief Of all places that coarse_size_points() looks at the one where the longest part of a
/// tet's edges is longest in sizes. Local; a pure function of its arguments.
/// @param[in] coarse_edge As of EdgeLengths.
[[nodiscard]] PartInSizes longest_part_in_sizes(const mesh::CoarseMesh& coarse,
                                                const mesh::EdgeLevels& levels,
                                                const SizeField& sizes, double coarse_edge);

/// @brief For each edge of a coarse mesh, its length in radii of curvature of the surface beside
/// it; 0 off the surface, and where that is flat. Local; O(n log n).
///
/// The surface turns by the angle between two triangles of one patch over two fifths of their
/// heights on the common edge. So the radius of a cylinder comes out a fifth too small, that of a
/// sphere a fifth too large.
/// @param[in] edge_vertices mesh::coarse_edges(). @return Shape (num_edges).
[[nodiscard]] std::vector<double> lengths_in_radii(const mesh::CoarseMesh& coarse,
                                                   std::span<const LocalIndex> edge_vertices);

}  // namespace tessera::sizing
