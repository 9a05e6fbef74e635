// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/surface/patch_surface.hpp"
#include "tessera/surface/size_function.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {

/// Edges over the thickness of a wall. Tets across it then have angles of some 8 degrees. Half of
/// it gave a quarter more tets and smallest angles that were hardly larger.
inline constexpr double kEdgesOfWall = 8.0;

/// Parts of the largest size. Thinner walls get flatter tets, or a sheet of nothing would make
/// millions of triangles.
inline constexpr double kLeastOfWall = 0.1;

/// @brief Triangles of a surface with another sheet behind material at a short distance: edges
/// there are at most kEdgesOfWall times as long, or the tets between the sheets would be flat.
/// Local.
///
/// From the middle of each triangle a ray goes into the material on each side. Sheets that meet in
/// a curve make no wall: no size makes the angle there better.
/// @pre Edges are hardly longer than the wanted sizes; a flat triangle has one middle only.
[[nodiscard]] std::vector<SizeSource> thin_walls_of(
    const EditableSurface& surface, const std::vector<std::array<LocalIndex, 2>>& patch_materials,
    double largest);

}  // namespace tessera::surface
