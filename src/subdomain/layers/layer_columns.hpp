// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::subdomain {

/// @brief The columns over all vertices of a skin that lie on walls; empty without layers. Local.
/// @param[in] complex, lattice The skin was extracted from them.
/// @throws GeometryError if a projection fails.
[[nodiscard]] mesh::Columns make_columns(const mesh::Complex& complex,
                                         const mesh::RefinedLattice& lattice,
                                         const mesh::Skin& skin,
                                         const refine::RefineContext& refine, LocalIndex subdomain);

}  // namespace tessera::subdomain
