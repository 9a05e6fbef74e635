// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::model {

/// @brief Smooth patches of a surface and the feature curves between them.
///
/// A feature edge has a dihedral angle above the given one, or triangles of different `solid`s of
/// the file. A patch is a set of triangles connected over other edges. A curve is a polyline of
/// feature edges. It ends at vertices where not exactly two feature edges meet, or is a closed
/// loop. It may end inside a patch.
struct SurfaceFeatures {
  std::vector<LocalIndex> triangle_patch{};  ///< Shape (num_triangles); numbered by first triangle.
  std::vector<std::string> patch_names{};    ///< From the `solid`, where that has a name.
  std::vector<LocalIndex>
      edge_vertices{};                   ///< Shape (num_edges, 2), lower vertex first, ascending.
  std::vector<LocalIndex> edge_curve{};  ///< Shape (num_edges).
  IndexLists curve_vertices{};           ///< Polylines; a loop ends with its first vertex.

  [[nodiscard]] LocalIndex num_patches() const
  {
    return static_cast<LocalIndex>(patch_names.size());
  }
  [[nodiscard]] LocalIndex num_curves() const { return curve_vertices.num_lists(); }
  /// @brief Curve of the edge between two vertices, kNoIndex if it is no feature edge.
  [[nodiscard]] LocalIndex curve_of_edge(LocalIndex a, LocalIndex b) const;
};

/// @param feature_angle_deg  Angle between the normals, degrees in (0, 180).
/// @pre The surface passed check_surface(). Local.
[[nodiscard]] SurfaceFeatures find_features(const TriangleSurface& surface,
                                            double feature_angle_deg);

/// @brief Unit normal of each triangle. One whose height is below 1e-6 of the box diagonal,
/// so that its own normal is noise, takes the normal of its neighbour over the longest edge. Local.
/// @pre The surface passed check_surface().
[[nodiscard]] std::vector<Vec3> triangle_normals(const TriangleSurface& surface);

}  // namespace tessera::model
