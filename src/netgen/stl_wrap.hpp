// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/model/options.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/model/triangle_surface.hpp"
#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {

/// @brief The surface of an STL file, and what was wrapped if that had to be.
struct StlSurface {
  model::CheckedSurface checked{};
  model::Wrap wrap{};
};

/// @brief Checks the triangles of a file, and wraps them if they bound no body and the options say
/// so. Local.
///
/// With StlRepair::wrap also what cuts itself, or lies flat on itself, bounds none: no mesher could
/// fill it. What bounds a body stays as it is.
/// @param[in] reader  With the plain one nothing is joined that lies flat on each other.
/// @throws GeometryError as model::check_surface(), naming the key that wraps, and as
/// surface::wrap_surface().
[[nodiscard]] StlSurface checked_or_wrapped(const model::TriangleSoup& soup,
                                            const model::StlOptions& options, StepReader reader,
                                            const std::string& name);

}  // namespace tessera::netgen
