// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "tessera/model/options.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::geometry {

/// @brief The surface of an STL file, and what was wrapped if that had to be.
struct StlSurface {
  model::CheckedSurface checked{};
  model::Wrap wrap{};
};

/// @brief Makes one body of shells that lie flat on each other, if it can; `soup` is what `checked`
/// was made of.
using ShellUniter = std::function<void(const model::TriangleSoup& soup,
                                       model::CheckedSurface& checked, const std::string& name)>;

/// @brief Checks the triangles of a file, and wraps them if they bound no body and the options say
/// so. Local.
///
/// With StlRepair::wrap also what cuts itself, or lies flat on itself, bounds none: no mesher could
/// fill it. What bounds a body stays as it is.
/// @param[in] unite  Empty: what lies flat on each other is not joined.
/// @throws GeometryError as model::check_surface(), naming the key that wraps, and as
/// surface::wrap_surface().
[[nodiscard]] StlSurface checked_or_wrapped(const model::TriangleSoup& soup,
                                            const model::StlOptions& options,
                                            const ShellUniter& unite, const std::string& name);

}  // namespace tessera::geometry
