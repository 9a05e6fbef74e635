// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::subdomain {

/// @brief New, smaller factors for the points of walls whose layers are flat or inverted somewhere;
/// of a whole coarse triangle at once. With all of them at 0 its columns are those of the coarse
/// mesh, so repeated calls end.
/// @param[in] complex, lattice Of the subdomain, refined under the limiter of `refine`.
/// @return Empty if no layer is bad, or there are none.
/// @note Local.
[[nodiscard]] std::vector<mesh::PointLimit> find_column_folds(const mesh::Complex& complex,
                                                              const mesh::RefinedLattice& lattice,
                                                              const refine::RefineContext& refine,
                                                              LocalIndex subdomain);

}  // namespace tessera::subdomain
