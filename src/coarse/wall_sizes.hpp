// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"

#include "coarse/editable_surface.hpp"

namespace tessera::coarse {

/// Edges over the thickness of a wall. Tets across it then have angles of some 8 degrees. Half of
/// it gave a quarter more tets and smallest angles that were hardly larger.
inline constexpr double kEdgesOfWall = 8.0;

/// Parts of the largest size. Thinner walls get flatter tets, or a sheet of nothing would make
/// millions of triangles.
inline constexpr double kLeastOfWall = 0.1;

/// @brief The sizes of a surface's vertices, less where another sheet of it is near. Local.
///
/// From the middle of each triangle a ray goes up and one down its normal. What they hit first, at
/// distance g, limits the edges there:
/// - Across material to a few times g, or the tets between the sheets would be flat.
/// - Where the surface bends, so that its chords stay within a quarter of g. Two sheets that both
/// do
///   so do not cut each other.
///
/// So a flat sheet beside a gap is not limited at all. Sizes grow with the grading from there.
/// @pre Edges are hardly longer than the largest size; a flat triangle has one middle only.
[[nodiscard]] std::vector<double> wall_sizes(
    const EditableSurface& surface, const std::vector<std::array<LocalIndex, 2>>& patch_materials,
    const CoarseOptions& options);

}  // namespace tessera::coarse
