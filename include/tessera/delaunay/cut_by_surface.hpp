// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/delaunay/tetrahedralize.hpp"

namespace tessera::delaunay {

/// @brief Where a tet lies with respect to a closed surface.
enum class Side : std::uint8_t {
  inside,
  outside,
  crossed,  ///< A triangle goes through it, or overlaps one of its faces; or nobody can tell.
};

/// @brief A closed surface in Delaunay tets of its vertices and others.
struct SurfaceCut {
  std::vector<Side> tet_side{};  ///< Shape (num_tets).
  /// Shape (num_triangles): the corner 4 t + c whose opposite face the triangle is, of the tet that
  /// its normal points out of; kNoIndex: there is none.
  std::vector<LocalIndex> triangle_corner{};
  LocalIndex num_missing = 0;  ///< Triangles that are no face of any tet.
};

/// @brief Tells which tets lie inside of a closed surface, and which ones it crosses. Tets that are
/// not crossed lie on one side as a whole, as the triangles that are missing only go through tets
/// that are crossed. All tests are exact.
/// @param[in] xyz  Shape (num_points, 3): what the tets were made of.
/// @param[in] triangle_vertices  Shape (num_triangles, 3): rows of the points; normals point out.
/// No triangle is flat.
/// @param[in] first_inside  Points from this row on are known to lie inside. That tells the side of
/// tets where no triangle does.
/// @throws MeshError if tets lie on both sides, so that the surface is not closed or cuts itself.
/// @note Local; O(n log n).
[[nodiscard]] SurfaceCut cut_by_surface(std::span<const double> xyz, const Tetrahedralization& tets,
                                        std::span<const LocalIndex> triangle_vertices,
                                        LocalIndex first_inside);

}  // namespace tessera::delaunay
