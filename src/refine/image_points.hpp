// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/orbits.hpp"
#include "tessera/mesh/refined_lattice.hpp"

namespace tessera::refine {

/// @brief A point of the edge that is this side of a triangle: `k` counts the triangle's intervals.
/// Local.
[[nodiscard]] Vec3 point_of_side(const mesh::Complex& complex, const mesh::RefinedLattice& points,
                                 LocalIndex t, std::size_t side, LocalIndex k);

/// @brief Moves what was refined as another member of its orbit to where it belongs. Local; does
/// nothing without orbits.
/// @param[in] orbits_of_edge The table that an edge of the skeleton was refined by.
/// @param[in] position Of a coarse vertex. Corners go there, as several transforms may lead there,
/// which differ by rounding.
void move_to_images(const mesh::Complex& complex, const mesh::Orbits& orbits,
                    const std::function<const mesh::OrbitTable&(LocalIndex)>& orbits_of_edge,
                    const std::function<Vec3(LocalIndex)>& position, mesh::RefinedLattice& points);

}  // namespace tessera::refine
