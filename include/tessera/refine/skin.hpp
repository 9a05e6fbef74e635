// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::refine {

/// @brief The skin of a subdomain from the refined lattice of its skin_complex(), or of the
/// TetComplex::faces of all its tets. Entities off the skeleton are passed over. Vertices have the
/// numbers of mesh::LatticeNumbering.
/// @note Local.
[[nodiscard]] mesh::Skin extract_skin(const mesh::Complex& complex,
                                      const mesh::RefinedLattice& lattice,
                                      const mesh::Skeleton& skeleton, LocalIndex subdomain);

}  // namespace tessera::refine
