// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::surface {

/// @brief What mend_surface() did.
struct MendStatistics {
  LocalIndex num_flips = 0;
  LocalIndex num_collapses = 0;
  LocalIndex num_splits = 0;  ///< Of edges beside which a vertex lay; it went into them.
  LocalIndex num_moves = 0;

  [[nodiscard]] LocalIndex total() const
  {
    return num_flips + num_collapses + num_splits + num_moves;
  }
};

/// @brief Makes bad triangles of a coarse surface better, on the geometry. Local.
///
/// A triangle is bad if it has an angle below 20 degrees. Worst ones first, an edge of it is
/// flipped, a short one collapsed, a long one split where the third vertex nearly lies on it, a
/// vertex taken out of a curve, or its vertices are moved. Curves stay curves and their ends stay.
/// A step is taken if it makes the smallest angle around larger, turns no triangle much, and keeps
/// new triangles near the geometry. If the surface cuts itself then, all is done again with no
/// vertex taken out of a curve; if it still does, it stays as it was.
///
/// Parameters of what has changed are those of the model near the ones that were there; a model
/// that needs them exact looks for them again. Vertices keep their numbers; new ones come last, and
/// some are of no face any more. The same arguments give the same bits.
/// @throws GeometryError if a projection fails.
MendStatistics mend_surface(CoarseSurface& surface, const model::Model& model);

}  // namespace tessera::surface
