// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::subdomain {

/// @brief Points of a lattice, on both sides of the layers.
struct LatticePoints {
  std::vector<mesh::HostPoint> names{};  ///< By the lattice; each once.
  std::vector<double> tets_xyz{};        ///< Shape (num_points, 3).
  std::vector<double> walls_xyz{};       ///< Shape (num_points, 3).
};

/// @brief The columns over those of the points that lie on walls. Local.
/// @param[in] complex, lattice The points are theirs. @pre The mesh has layers.
/// @throws GeometryError if a projection fails.
[[nodiscard]] mesh::Columns make_columns(const mesh::Complex& complex,
                                         const mesh::RefinedLattice& lattice,
                                         const LatticePoints& points,
                                         const refine::RefineContext& refine);

/// @brief The columns over all vertices of a skin that lie on walls; empty without layers. Local.
/// @param[in] complex, lattice The skin was extracted from them.
/// @throws GeometryError if a projection fails.
[[nodiscard]] mesh::Columns make_columns(const mesh::Complex& complex,
                                         const mesh::RefinedLattice& lattice,
                                         const mesh::Skin& skin,
                                         const refine::RefineContext& refine, LocalIndex subdomain);

}  // namespace tessera::subdomain
