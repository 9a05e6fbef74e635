// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::coarse {

/// @brief Points inside of a skin, on a lattice whose spacing is that of the skin's edges beside it
/// and grows from there, up to the largest edge. Local; a pure function.
/// @return Shape (num_points, 3).
[[nodiscard]] std::vector<double> lattice_points(const surface::DomainSkin& skin,
                                                 const surface::CoarseOptions& options);

}  // namespace tessera::coarse
