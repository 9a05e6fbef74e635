// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief What the faces of some tets have to do with a triangle surface.
struct SurfaceMatch {
  std::vector<LocalIndex> triangle_tet{};  ///< Shape (num_triangles); the tet behind each, kNoIndex
                                           ///< where there is none.
  bool is_closed = true;                   ///< No other face of the tets stands alone.
};

/// @brief Matches the boundary of tets with an outward surface, triangle for triangle.
///
/// Every face of a tet must be a triangle of the surface, seen from the right side, or one of two
/// that face each other. Faces that face each other are hashed with opposite signs and must cancel.
/// If the tets are also positive and have the surface's volume, there is no room for gaps or
/// overlaps.
/// @param[in] triangle_vertices Shape (num_triangles, 3), no triangle twice.
/// @param[in] num_surface_vertices All vertices of triangles are below it.
/// @param[in] tet_vertices Shape (num_tets, 4).
/// @note Local; linear.
[[nodiscard]] SurfaceMatch match_surface(std::span<const LocalIndex> triangle_vertices,
                                         LocalIndex num_surface_vertices,
                                         std::span<const LocalIndex> tet_vertices);

}  // namespace tessera::mesh
