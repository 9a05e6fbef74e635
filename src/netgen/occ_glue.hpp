// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "netgen/occ_cad_file.hpp"

namespace tessera::netgen {

/// @brief Names the images of the named faces and solids of `shape` after their originals.
void follow_names(const TopoDS_Shape& shape, ShapeNames& names,
                  const std::function<TopTools_ListOfShape(const TopoDS_Shape&)>& images_of);

/// @brief A compound of the solids in which two that touch share the faces between them, so that
/// their meshes conform. Solids that overlap are cut into parts. Those that touch along curves or
/// in points only keep their faces whole. What was done is in `cad.repairs`.
[[nodiscard]] TopoDS_Shape glued(const std::vector<TopoDS_Shape>& solids, CadFile& cad);

}  // namespace tessera::netgen
