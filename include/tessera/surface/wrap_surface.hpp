// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/model/stl_file.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::surface {

/// @brief A closed surface around triangles that bound no body. Lengths are the file's.
struct WrappedSurface {
  model::TriangleSoup soup{};  ///< Closed, a manifold, outwards; one `solid`.
  double tolerance = 0.0;      ///< Edge of the lattice's cells.
  /// From the wrap to the nearest triangle of the file: large where the wrap closes a hole.
  double distance_max = 0.0;
  /// From the triangles of the file to the wrap: large where some lie inside of it, or bound
  /// nothing and were left out.
  double file_distance_max = 0.0;
};

/// @brief What a tolerance that is not given is, of the diagonal of the box. Half of it leaves a
/// plate of 1 % of its diagonal whole, and takes four times as long; most files take seconds.
inline constexpr double kWrapTolerance = 0.005;

/// @brief Wraps loose triangles: makes a closed surface around what they enclose by more than half,
/// by winding numbers @cite barill2018. Local.
///
/// The numbers are taken at points of a lattice with cells of `tolerance`. The boundary between
/// those above and below 1/2 is a closed manifold of squares (WrapLattice). Each has a corner in
/// each cell, placed by the planes of the file's triangles there @cite ju2002, so that edges of the
/// file stay edges, and then on the nearest triangle. Where triangles of the wrap would cut each
/// other or turn over, corners go back towards the middles of their cells, where they do neither.
/// So holes are closed, bodies that cross become one, and what is thinner than the tolerance, or no
/// more than a sheet, is lost.
///
/// @param[in] tolerance File length unit; 0: kWrapTolerance of the diagonal of the box.
/// @param[in] name      What messages call the file.
/// @throws GeometryError naming the least tolerance that fits into memory; if nothing is enclosed.
[[nodiscard]] WrappedSurface wrap_surface(const model::TriangleSoup& soup, double tolerance,
                                          const std::string& name);

}  // namespace tessera::surface
