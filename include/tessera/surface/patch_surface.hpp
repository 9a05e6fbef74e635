// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::surface {

/// @brief Triangulated boundary of one or more materials, cut into patches by curves. An edge on no
/// curve has two triangles of one patch; one on a curve has any number of them, from two on.
struct PatchSurface {
  using Edge = std::array<LocalIndex, 2>;      ///< Lower vertex first.
  using Triangle = std::array<LocalIndex, 3>;  ///< Seen from the patch's second material.

  std::vector<Vec3> vertex_xyz{};
  std::vector<char> vertex_is_fixed{};  ///< Ends of curves, and what else must stay in its place.
  std::vector<Triangle> triangles{};
  std::vector<LocalIndex> triangle_patch{};
  std::vector<Edge> edges{};  ///< Those on curves, ascending.
  std::vector<LocalIndex> edge_curve{};
  std::vector<std::array<double, 2>> edge_t{};  ///< End parameters on the curves; empty if none.
  /// The material below and above each patch, from 1; 0: none.
  std::vector<std::array<LocalIndex, 2>> patch_materials{};
  /// Largest edge that the model itself wants at each triangle, also for its curvature; empty: it
  /// does not say, and the curvature is that of the triangles.
  std::vector<double> triangle_max_size{};
  /// Corner parameters on the patches' surfaces, one row a triangle; empty if there are none.
  std::vector<std::array<std::array<double, 2>, 3>> triangle_uv{};

  [[nodiscard]] LocalIndex num_patches() const
  {
    return static_cast<LocalIndex>(patch_materials.size());
  }
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const
  {
    const Triangle& v = triangles[t];
    return {vertex_xyz[at(v[0])], vertex_xyz[at(v[1])], vertex_xyz[at(v[2])]};
  }
};

/// @brief Separates sheets that share an edge on no curve: each of them but the first gets a vertex
/// of its own in the middle of the edge. Local.
///
/// The sheets, of one patch or of two, share it because they cut the same corner of the curve
/// between them.
void separate_patches(PatchSurface& surface);

/// @brief Throws MeshError unless every edge has the triangles that PatchSurface promises, naming
/// the first that has not. Local.
void validate(const PatchSurface& surface);

}  // namespace tessera::surface
