// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <csg.hpp>

#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

#include "cad/cad_file.hpp"

namespace tessera::netgen {

/// @brief A coarse surface of a CSG model, made of OpenCASCADE's triangles of its solids, but on
/// the surfaces of the file, with its edges, numbers, names and sizes. Local.
/// @param[in] csg    Of that geometry.
/// @param[in] solids Those of solids_of_csg().
/// @param[in] box    All solids fill it.
/// @throws NetgenError if the solids are not those of the file, or their surface cuts itself.
/// @throws GeometryError of OpenCASCADE, or if a projection fails.
[[nodiscard]] surface::CoarseSurface remesh_csg(const model::Model& csg,
                                                const ::netgen::CSGeometry& geometry,
                                                cad::CadFile solids, const ::netgen::Box<3>& box,
                                                const surface::CoarseOptions& options,
                                                const std::string& file_name);

}  // namespace tessera::netgen
