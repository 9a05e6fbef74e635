// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TopoDS_Shape.hxx>

#include "cad/cad_file.hpp"

namespace tessera::cad {

/// @brief Glued solids without flaps: faces that bound one solid from both sides, and so nothing.
/// Modellers leave such sheets where they bend a lead or a label of no thickness round a body. In
/// a solid by itself both sides are faces of their own; glued to the body, they are one face, which
/// the solid has twice. Names follow, and `cad.repairs` gets a line.
/// @param[in] fused  Solids that share the faces at which they touch.
/// @return The shape itself if no solid has flaps. A solid that is no valid one without them stays.
[[nodiscard]] TopoDS_Shape without_flaps(const TopoDS_Shape& fused, CadFile& cad);

}  // namespace tessera::cad
