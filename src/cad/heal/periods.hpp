// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ShapeBuild_ReShape.hxx>
#include <TopoDS_Shape.hxx>

namespace tessera::cad {

/// @brief Whether an edge is marked as a point of its surface, and is none. Local.
[[nodiscard]] bool has_false_points(const TopoDS_Shape& shape);

/// @brief Makes wires of periodic surfaces close in their parameters. Curves in another period than
/// those before and behind them are moved by periods. Edges that are falsely marked as a point of
/// the surface are left out.
///
/// OpenCASCADE's reader of STEP files makes such wires of circles on surfaces of revolution.
/// ShapeFix does not know what to do with them: it drops the faces beside.
///
/// Curves that are moved are changed in place: the same edges in space, with other parameters.
/// @param changes Gets what is left out.
/// @return The changed shape. Local.
[[nodiscard]] TopoDS_Shape with_closed_wires(const TopoDS_Shape& shape,
                                             ShapeBuild_ReShape& changes);

}  // namespace tessera::cad
