// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/surface/overlap.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::netgen {

/// @brief Names of patches (from 0) and materials (from 1); empty text: none.
struct SurfaceNames {
  std::function<std::string(LocalIndex patch)> patch{};
  std::function<std::string(LocalIndex material)> material{};
};

/// @brief Refuses a remeshed surface that cuts itself. NETGEN would say only that there is such a
/// place.
/// @param[in] what Put before the error: which model.
/// @note Local. @throws NetgenError with the faces and the place if there are any.
void require_no_overlaps(const std::vector<surface::Overlap>& overlaps,
                         const surface::PatchSurface& surface, const SurfaceNames& names,
                         const std::string& what);

/// @brief A remeshed surface in the form in which its domains are filled; patch and curve numbers
/// are the model's. Without parameters.
/// @param[in] max_size Largest edge inside, file length unit.
/// @note Local.
[[nodiscard]] surface::CoarseSurface to_coarse_surface(const surface::PatchSurface& surface,
                                                       double max_size, const SurfaceNames& names);

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
