// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/surface_features.hpp"
#include "tessera/model/triangle_surface.hpp"
#include "tessera/surface/options.hpp"

#include "netgen/model_mesher.hpp"

namespace tessera::netgen {

/// @brief Coarse surface of an STL surface by NETGEN's STL mesher, with our patches and curves.
///
/// NETGEN gets our triangles and our feature edges and no other, so it never decides by an angle of
/// its own. Inside a patch it may add edges, to start a face or to unroll it. These are not
/// segments of the result.
/// @param name  What messages call the model.
/// @param use   Gets NETGEN's mesh, scaled by a power of two.
/// @note May crash or hang inside NETGEN.
/// @throws NetgenError if NETGEN gives up.
[[nodiscard]] surface::CoarseSurface mesh_stl_surface(const model::TriangleSurface& surface,
                                                      const model::SurfaceFeatures& features,
                                                      const surface::CoarseOptions& options,
                                                      const std::string& name,
                                                      const NetgenSurfaceUser& use);

}  // namespace tessera::netgen
