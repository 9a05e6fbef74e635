// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "cut/weld.hpp"

namespace tessera::cut {

/// The solids on the two sides of a triangle, from 0: its normal points out of the first one. The
/// second one is kNoIndex where there is none.
using TriangleSolids = std::array<LocalIndex, 2>;

/// @brief Which solids each triangle bounds. A description says that of whole faces, and in CSG one
/// face may bound different solids at different places, each alone.
///
/// Triangles are connected to sheets over edges that have just two. A sheet bounds solids that all
/// of its faces bound. If that leaves a choice, that one is taken by which surfaces close and
/// enclose the volumes that the description has.
/// @return Shape (number of triangles).
[[nodiscard]] std::vector<TriangleSolids> solids_of_triangles(const WeldedModel& welded,
                                                              const model::ModelDescription& model);

}  // namespace tessera::cut
