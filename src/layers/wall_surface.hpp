// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::layers {

/// @brief A vertex on a wall, and where its column may go.
struct WallVertex {
  LocalIndex vertex = kNoIndex;   ///< Of the coarse mesh.
  Vec3 wall{};                    ///< Where it is on the wall.
  Vec3 column{};                  ///< To where the tets should begin; zero: there is no way.
  LocalIndex stack = 0;           ///< The layers of its column, a row of mesh::WallLayers::ends.
  LocalIndex patch = kNoIndex;    ///< Without layers; the column goes along it.
  LocalIndex curve = kNoIndex;    ///< Between such patches; the column goes along it.
  double t = 0.0;                 ///< Of `wall` on the curve.
  model::SurfaceParameters uv{};  ///< Of `wall` on the patch.
  LocalIndex origin = kNoIndex;   ///< Row of the vertex that this one goes along with as its image;
                                  ///< its own for all others.
  LocalIndex image = 0;           ///< Row of WallSurface::images that leads here from there.
};

/// @brief A triangle of the geometry that has a vertex on a wall.
struct SurfaceTriangle {
  LocalIndex face = kNoIndex;  ///< Of the coarse mesh.
  std::array<LocalIndex, 3>
      vertices{};  ///< Of the coarse mesh; seen from the tets, it points away.
  bool is_wall = false;
  Vec3 normal{};             ///< Away from the tets, before any vertex has moved; of length 1.
  double least_shape = 0.0;  ///< triangle_shape() that it must keep.
};

/// @brief Twice the area by the square of the longest side; 0.87 at most.
[[nodiscard]] double triangle_shape(const std::array<Vec3, 3>& corners);

/// @brief The walls of a coarse mesh.
struct WallSurface {
  std::vector<WallVertex> vertices{};        ///< Ascending.
  std::vector<SurfaceTriangle> triangles{};  ///< In the order of faces.
  std::vector<LocalIndex>
      wall_of_vertex{};          ///< Shape (num_vertices): row of vertices, or kNoIndex.
  std::vector<Affine> images{};  ///< The first is the identity.
};

/// @brief The layers of one patch.
struct PatchLayers {
  double thickness = 0.0;  ///< 0: none.
  LocalIndex stack = 0;    ///< Row of mesh::WallLayers::ends.
};

/// @brief A leaning column is longer, so that the layers keep their height; but no more than that.
inline constexpr double kMostLean = 2.5;

/// @brief Whether two triangles of walls meet at a *ridge*: an edge as that behind a wing, which is
/// too sharp for one column between them. Local.
/// @param[in] first, second Their normals. @param[in] away From the edge into the second one.
[[nodiscard]] bool is_ridge(const Vec3& first, const Vec3& second, const Vec3& away);

/// @brief The direction whose smallest cosine to the normals is largest. Local.
[[nodiscard]] Vec3 best_direction(std::span<const Vec3> normals);

/// @brief Finds walls and the columns on them. Local.
///
/// Where patches with layers meet, columns are those of the thinnest ones. Columns on periodic
/// sides that are images of each other are alike. There is none where a wall goes on across the
/// side as a patch without layers.
/// @param[in] patches Shape (num_patches).
/// @pre No wall has tets on both sides, or is a periodic side.
[[nodiscard]] WallSurface find_walls(const mesh::CoarseMesh& mesh,
                                     std::span<const PatchLayers> patches);

}  // namespace tessera::layers
