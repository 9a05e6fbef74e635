// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/size_points.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

/// A larger mesh is taken as it is: what is fine already would take too long to mesh again.
constexpr LocalIndex kMostTetsToMeshAgain = 300'000;

/// @brief Sizes for another coarse mesh, where the surface of this one would fold once its edges are
/// halved on the geometry. Local; a projection for each edge of the surface.
///
/// That happens where edges are too long for what is beside them: the middle of an edge on a curve
/// lies beyond another curve of a narrow face, or one sheet beyond another. Such points have to be
/// kept off the geometry when the mesh is refined. Edges half as long are off by a quarter.
/// @return Four points for each such triangle.
[[nodiscard]] mesh::SizePoints sizes_of_folds(const mesh::CoarseMesh& mesh,
                                              const model::Model& model);

}  // namespace tessera::coarse
