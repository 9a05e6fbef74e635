// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/model/triangle_surface.hpp"

namespace tessera::cad {

/// @brief Makes one body of shells that lie flat on each other, or of one that does so on itself,
/// as OpenCASCADE parts space by their planes. Local.
///
/// Such a surface bounds a solid, but has sheets of nothing, or of noise, inside it. No mesher can
/// fill that. Shells that the file turns the other way are cavities.
///
/// The surface stays as it is where it has no such place, has several solids, or is too large
/// for OpenCASCADE; also where what comes out is not the same body, or touches itself still.
/// @param[in] soup  What `checked` was made of.
void unite_flat_contacts(const model::TriangleSoup& soup, model::CheckedSurface& checked,
                         const std::string& name);

}  // namespace tessera::cad
