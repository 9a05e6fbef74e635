// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/optimize/schedule.hpp"
#include "tessera/optimize/tet_mesh.hpp"

/// Smoothing alone: vertices move, tets keep their corners. So it needs no neighbours of tets, and
/// costs a quarter of optimize().
namespace tessera::optimize {

/// @brief Moves the vertices that are not fixed, one after the other.
///
/// Tets that begin flat or inverted are untangled first, as far as moving vertices can. Then come
/// the steps. If all tets were positive they stay so, and no tet gets worse than the worst was.
/// @param[in] mesh `vertex_fixed` is needed, and says all: vertices of the boundary must be
/// flagged. `tet_neighbours` is not read.
/// @param[in] schedule Its steps are Step::smooth, Step::smooth_worst and Step::tighten.
/// @return The new positions, shape (num_vertices, 3). Tets may still be flat or inverted.
/// @throws MeshError if an index is out of range or a corner is not finite. ConfigError if another
/// step is asked for.
/// @note Local; a pure function with the same bits for every instruction set. About 0.2
/// microseconds a tet and step with AVX2.
[[nodiscard]] std::vector<double> smooth(const TetMesh& mesh, const Schedule& schedule);

/// @brief Moves the flagged vertices all at once, each as if the others stayed.
///
/// A vertex goes towards the least sum of eta^-3 around it, but by less than half of the width of
/// any of its tets. So tets that are positive stay so whichever of their vertices move. A vertex
/// of a tet that is not positive stays.
///
/// The step depends on nothing but the tets around the vertex, in the order given. So two meshes
/// that hold the same tets around a vertex move it by the same bits.
/// @param[in] flags Shape (num_vertices); 1: move. All tets around such a vertex must be there.
/// @return The new positions, shape (num_vertices, 3).
/// @throws MeshError if an index is out of range or a corner is not finite.
/// @note Local; linear in the tets around flagged vertices.
[[nodiscard]] std::vector<double> smooth_at_once(const TetMesh& mesh,
                                                 const std::vector<std::uint8_t>& flags);

}  // namespace tessera::optimize
