// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "tessera/model/description.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace netgen {
class CSGeometry;
}  // namespace netgen

namespace tessera::netgen {

/// @brief What a CSG model holds, by the triangles of a surface mesh in its numbers: areas and
/// volumes are those of the triangles. Local.
/// @param[in] number_of_curve What users call a curve.
[[nodiscard]] model::ModelDescription describe_csg(
    const ::netgen::CSGeometry& geometry, const surface::CoarseSurface& surface,
    const std::function<std::string(LocalIndex)>& number_of_curve);

}  // namespace tessera::netgen
