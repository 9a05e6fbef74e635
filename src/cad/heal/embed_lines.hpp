// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <TopoDS_Shape.hxx>

#include "tessera/model/options.hpp"

#include "cad/cad_file.hpp"

namespace tessera::cad {

/// @brief Puts the polylines of `options.embedded` beside the solids of `cad.shape`, and with
/// LooseParts::embed the curves that the file has there. Local.
///
/// The solids stay as they are. A line is divided where it goes through a face; each piece in a
/// solid or on its surface is an edge of the shape, after all edges of solids. Names go on to the
/// pieces. What lies outside is left out.
/// @param[in] loose Edges that are of no face.
/// @throws GeometryError if one of `options.embedded` lies outside of all solids, or OpenCASCADE
/// cannot do it.
void embed_lines(const std::vector<TopoDS_Shape>& loose, const model::AssemblyOptions& options,
                 CadFile& cad);

}  // namespace tessera::cad
