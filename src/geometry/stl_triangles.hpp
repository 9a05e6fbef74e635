// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/triangle_surface.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::geometry {

/// @brief The vertices and triangles of a surface, without patches. Local.
[[nodiscard]] inline surface::PatchSurface triangles_of(const model::TriangleSurface& surface)
{
  surface::PatchSurface triangles;
  for (LocalIndex v = 0; v < surface.num_vertices(); ++v) {
    triangles.vertex_xyz.push_back(surface.position(v));
  }
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const LocalIndex* v = &surface.triangle_vertices[3 * at(t)];
    triangles.triangles.push_back({v[0], v[1], v[2]});
  }
  return triangles;
}

}  // namespace tessera::geometry
