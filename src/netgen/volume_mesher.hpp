// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::netgen {

/// @brief Names of patches (from 0) and materials (from 1); empty text: none.
struct SurfaceNames {
  std::function<std::string(LocalIndex patch)> patch{};
  std::function<std::string(LocalIndex material)> material{};
};

/// @brief Fills a surface with tets by NETGEN's volume mesher; its triangles become the faces of
/// the result, patch and curve numbers the model's. Without parameters.
/// @param[in] what Put before an error: which model.
/// @note May crash or hang inside NETGEN.
/// @throws NetgenError if NETGEN gives up or the surface cuts itself.
[[nodiscard]] mesh::CoarseMesh mesh_volume(const coarse::PatchSurface& surface,
                                           const coarse::CoarseOptions& options,
                                           const SurfaceNames& names, const std::string& what);

}  // namespace tessera::netgen
