// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/model/model.hpp"

namespace tessera::refine {

/// @brief Everything a lattice point's position is a pure function of. Borrowed, but for levels.
struct RefineContext {
  const mesh::CoarseMesh& coarse;
  const mesh::Skeleton& skeleton;
  const model::Model& model;
  const mesh::ProjectionLimiter& limiter;
  mesh::EdgeLevels levels{};      ///< Of the coarse edges.
  bool measure_distance = false;  ///< Fill mesh::RefinedLattice::distance; twice the projections.
};

/// @brief Refines the edges and triangles of a complex, level by level. New points on the geometry
/// are projected at every level, curves first: one projection at the end would fold.
///
/// With layers the walls are refined first (mesh::RefinedLattice::walls). The points of the tets
/// behind them follow from these and from the columns of the coarse vertices.
///
/// A point's position depends on its coarse entity and the context only. So every subdomain that
/// shares it computes the same bits without a message.
///
/// @note Local.
/// @throws GeometryError if a projection fails.
[[nodiscard]] mesh::RefinedLattice refine_lattice(const mesh::Complex& complex,
                                                  const RefineContext& context);

/// @brief The same with levels of its own. A point has the same bits on any levels that have it.
/// @param[in] levels Of the complex. No side of a triangle has less than the triangle.
[[nodiscard]] mesh::RefinedLattice refine_lattice(const mesh::Complex& complex,
                                                  mesh::LatticeLevels levels,
                                                  const RefineContext& context);

/// @brief A point of the column over point `k` of the `n` intervals of a skeleton edge. At the rim
/// of a wall it is put onto the patch without layers beside it, as far as the limiter lets that
/// point of the edge go. Local.
/// @throws GeometryError if the projection fails.
[[nodiscard]] Vec3 side_point_of_edge(const RefineContext& context, LocalIndex edge, LocalIndex n,
                                      LocalIndex k, const Vec3& point);

/// @brief The same for a column over a skeleton vertex: onto the curve that leaves the wall there,
/// else onto the patch, as far as key_of_vertex_limit() allows.
[[nodiscard]] Vec3 side_point_of_vertex(const RefineContext& context, LocalIndex vertex,
                                        const Vec3& point);

/// @brief What holds back the column over a vertex with this mesh::Skeleton::vertex_side_edge, as a
/// limiter names no vertices: the middle of that edge. Local.
[[nodiscard]] mesh::LatticePointKey key_of_vertex_limit(LocalIndex side_edge);

}  // namespace tessera::refine
