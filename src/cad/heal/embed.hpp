// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <TopoDS_Shape.hxx>

#include "tessera/model/options.hpp"

#include "cad/cad_file.hpp"

namespace tessera::cad {

/// @brief Puts faces into the solids of `cad.shape`: those of `options.embedded` that
/// are no lines, and with
/// LooseParts::embed those that the file has beside its solids. Local.
///
/// Where a face lies in a solid it becomes a face of it, and where it divides a solid this becomes
/// several, which `cad.solid_body` says. Where it lies on the surface of a solid it becomes a face
/// there. What lies outside is left out. Names go on to all pieces, and `cad.given_face` says of
/// what faces are pieces.
/// @param[in] loose Faces that are beside the solids.
/// @throws GeometryError if one of `options.embedded` lies outside of all solids, or OpenCASCADE
/// cannot do it.
void embed_faces(const std::vector<TopoDS_Shape>& loose, const model::AssemblyOptions& options,
                 CadFile& cad);

}  // namespace tessera::cad
