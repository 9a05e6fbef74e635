// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/model/description.hpp"

namespace netgen {
class CSGeometry;
}  // namespace netgen

namespace tessera::netgen {

/// @brief What a CSG model holds, by the triangles of a surface mesh in its numbers: areas and
/// volumes are those of the triangles. Edges are left out. Local.
[[nodiscard]] model::ModelDescription describe_csg(const ::netgen::CSGeometry& geometry,
                                                   const coarse::CoarseSurface& surface);

}  // namespace tessera::netgen
