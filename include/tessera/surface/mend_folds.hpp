// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::surface {

/// @brief What mend_folds() did.
struct FoldStatistics {
  /// Triangles with a child of the first level that looks the other way.
  LocalIndex num_before = 0;
  LocalIndex num_left = 0;
  LocalIndex num_flips = 0;             ///< Also at corners and needles.
  LocalIndex num_cuts = 0;              ///< Of edges that got a vertex on the geometry; also there.
  LocalIndex num_steps_of_needles = 0;  ///< Of both, those where children would have been needles.
};

/// @brief Changes a coarse surface where it would fold when it is refined. Local.
///
/// There an edge is too long for what it stands for: its arc is higher than the triangle beside it.
/// An edge of such a triangle is flipped if that is the end of it. Else the one with the highest
/// arc is cut there; if the new vertex lies beyond the next side, that side is flipped to it. The
/// height of half an arc is a quarter. All else stays as it is. If the surface cuts itself then, or
/// has no fewer folds, it stays as it was.
///
/// A surface without folds on its first level, or without any now, is treated in the same way for
/// corners that fold after many levels. Children there follow the tangents of the sides, which meet
/// at 180 degrees where two sides lie on one circle. No bad angle is made for it. At last it is
/// treated for children of the first level that would be needles.
///
/// Parameters are those of mend_surface(). The same arguments give the same bits.
/// @throws GeometryError if a projection fails.
FoldStatistics mend_folds(CoarseSurface& surface, const model::Model& model);

}  // namespace tessera::surface
