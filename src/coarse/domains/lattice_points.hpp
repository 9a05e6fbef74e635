// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::coarse {

/// @brief Points of a lattice.
struct InsidePoints {
  std::vector<double> xyz{};   ///< Shape (num_points, 3).
  std::vector<double> side{};  ///< Shape (num_points): LatticePoint::side.
};

/// @brief Points inside of a skin, on a lattice whose spacing is that of the skin's edges beside it
/// and grows from there, up to the largest edge. Local; a pure function.
[[nodiscard]] InsidePoints lattice_points(const surface::DomainSkin& skin,
                                          const surface::CoarseOptions& options);

}  // namespace tessera::coarse
