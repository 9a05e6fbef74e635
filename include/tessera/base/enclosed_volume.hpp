// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief What a closed surface encloses; positive if its normals point out. It is measured from
/// the first vertex, so that a small body far from the origin keeps its digits.
/// @param[in] xyz Shape (num_vertices, 3).
/// @param[in] triangle_vertices Shape (num_triangles, 3).
[[nodiscard]] inline double enclosed_volume(std::span<const double> xyz,
                                            std::span<const LocalIndex> triangle_vertices)
{
  double volume = 0.0;
  for (std::size_t i = 0; i < triangle_vertices.size(); i += 3) {
    const LocalIndex* v = &triangle_vertices[i];
    volume +=
        tet_volume(point_at(xyz, 0), point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]));
  }
  return volume;
}

}  // namespace tessera
