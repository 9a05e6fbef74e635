// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/overlap.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::geometry {

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

/// @brief Adds the domains that faces bound, and their materials. Local.
/// @param[in] material      Of a domain, both from 1.
/// @param[in] material_name May be empty, and give empty texts: "material_N".
void add_domains(surface::CoarseSurface& surface, double max_size,
                 const std::function<LocalIndex(LocalIndex)>& material,
                 const std::function<std::string(LocalIndex)>& material_name);

}  // namespace tessera::geometry
