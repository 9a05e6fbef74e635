// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::netgen {

/// @brief Fills a domain by NETGEN's volume mesher. Sizes inside follow from the skin, the options'
/// grading and their points.
/// @note Local; may crash or hang inside NETGEN.
/// @throws NetgenError if NETGEN gives up.
[[nodiscard]] surface::DomainTets fill_domain(const surface::DomainSkin& skin,
                                              const surface::CoarseOptions& options);

/// @brief Better tets in the same skin: by our optimiser, which is some twenty times faster than
/// NETGEN's, and by NETGEN where it left a tet with two faces on one patch. Local.
[[nodiscard]] surface::DomainTets improve_domain(const surface::DomainSkin& skin,
                                                 surface::DomainTets tets);

}  // namespace tessera::netgen
