// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/surface/size_function.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {

/// Edges over the width of a strip. Right triangles across it then have angles of 14 degrees.
inline constexpr double kEdgesOfStrip = 4.0;

/// Parts of the largest size: narrower strips get longer edges than that.
inline constexpr double kLeastOfStrip = 0.04;

/// The same where arcs beside the strip would be higher than it is wide with such edges.
inline constexpr double kLeastOfCurvedStrip = 0.004;

/// @brief Places where two curves of a patch are near each other: along a strip between them edges
/// are kEdgesOfStrip times as long as it is wide. Local.
///
/// Each edge on a curve looks from its middle for the nearest other edge around the same patch.
/// One that can be reached along the curves within three times the distance meets it at a corner:
/// there no size makes the angle better. Strips that `options.defeature` merges have no such
/// places.
/// @pre Edges are hardly longer than the wanted sizes; an edge has one middle only.
[[nodiscard]] std::vector<SizeSource> narrow_strips_of(const EditableSurface& surface,
                                                       const CoarseOptions& options);

}  // namespace tessera::surface
