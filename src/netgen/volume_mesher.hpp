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

}  // namespace tessera::netgen
