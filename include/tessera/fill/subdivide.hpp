// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/types.hpp"
#include "tessera/fill/kernel.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/refined_lattice.hpp"

namespace tessera::fill {

/// @brief Fills a subdomain with the children of its coarse tets, enumerated in closed form: 8^L
/// each, and some more where edges are one level finer (@see mesh::cut_tet()). Their outer faces
/// are the refined skin, whatever diagonals are chosen, so the piece conforms with pieces of any
/// other kernel.
///
/// Every octahedron is cut along the shortest diagonal of its coarse tet (Bey's ordering: at most
/// three similarity classes). Inner lattice points are midpoints of older points, level by level,
/// so what projection moved on the surface reaches the inside.
/// @param[in] complex All coarse tets of the subdomain. @param[in] lattice Refined lattice of
/// complex.faces.
/// @return Vertices of the skin first, in the order of mesh::LatticeNumbering; nothing is promised
/// about the sign of the tets: check_fill() tells.
/// @throws MeshError if 32-bit indices cannot hold the piece.
/// @note Local; no hash maps, no search: time and memory are linear in the tets.
[[nodiscard]] FillOutput subdivide(const mesh::TetComplex& complex,
                                   const mesh::RefinedLattice& lattice);

/// @brief Numbers that a subdivided piece will have; known before it is made.
struct SubdivisionCounts {
  GlobalIndex tets = 0;
  GlobalIndex interior_vertices = 0;
};

/// @brief Closed form of the numbers. Local. @param[in] complex Tets of `coarse`.
[[nodiscard]] SubdivisionCounts count_subdivision(const mesh::TetComplex& complex,
                                                  const mesh::CoarseMesh& coarse,
                                                  const mesh::EdgeLevels& levels);

}  // namespace tessera::fill
