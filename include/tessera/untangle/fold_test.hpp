// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::untangle {

/// @brief Whether each coarse vertex ends an edge on the geometry. Shape (num_vertices). Local.
[[nodiscard]] std::vector<char> vertices_on_geometry(const mesh::CoarseMesh& coarse,
                                                     const mesh::Skeleton& skeleton);

/// @brief Those of the tets that have an edge on the geometry: only these can fold. Local.
/// @param[in] on_geometry vertices_on_geometry() of the mesh.
[[nodiscard]] std::vector<LocalIndex> tets_on_geometry(const mesh::CoarseMesh& coarse,
                                                       std::span<const LocalIndex> tets,
                                                       std::span<const char> on_geometry);

/// @brief New, smaller factors for the points that make a child of some tet flat or inverted.
///
/// Levels are tested one by one, up to the first that has a bad child. There, the new points on the
/// geometry of that child's tet are held back one step further. With all of them at 0 the level is
/// a plain subdivision and every child is as good as its parent, so repeated calls end.
/// @param[in] complex Tets to test. @param[in] lattice Its points under `limiter`.
/// @return Empty if no child is bad.
/// @note Local.
[[nodiscard]] std::vector<mesh::PointLimit> find_folds(const mesh::TetComplex& complex,
                                                       const mesh::Skeleton& skeleton,
                                                       const mesh::RefinedLattice& lattice,
                                                       const mesh::ProjectionLimiter& limiter);

/// @brief Steps of the limiter factor: 1, 3/4, 1/2, 1/4, 0.
[[nodiscard]] double next_factor(double factor);

}  // namespace tessera::untangle
