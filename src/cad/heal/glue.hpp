// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "tessera/model/assembly.hpp"

#include "cad/cad_file.hpp"
#include "cad/heal/fuse.hpp"

namespace tessera::cad {

/// @brief Names the images of the named faces and solids of `shape` after their originals.
void follow_names(const TopoDS_Shape& shape, ShapeNames& names,
                  const std::function<TopTools_ListOfShape(const TopoDS_Shape&)>& images_of);

/// @brief A compound of the solids in which two that touch share the faces between them, so that
/// their meshes conform. Those that touch along curves or in points only keep their faces whole.
/// What was found and done is in `cad.assembly` and `cad.repairs`.
/// @throws GeometryError if solids overlap and `options.overlap` does not say what is to be done.
[[nodiscard]] TopoDS_Shape glued(const Shapes& solids, const model::AssemblyOptions& options,
                                 CadFile& cad);

}  // namespace tessera::cad
