// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/description.hpp"

namespace netgen {
class CSGeometry;
class Mesh;
}  // namespace netgen

namespace tessera::netgen {

/// @brief What a CSG model holds, by NETGEN's triangles of its surfaces: areas and volumes are
/// those of the triangles. Edges are left out. Local.
[[nodiscard]] model::ModelDescription describe_csg(const ::netgen::CSGeometry& geometry,
                                                   const ::netgen::Mesh& surface_mesh);

}  // namespace tessera::netgen
