// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/editor.hpp"

namespace tessera::surface {

/// @brief Makes the worst triangles better, worst ones first: one of their edges is flipped, their
/// corners are moved, or one of their edges is collapsed. A step is taken only if the worst
/// triangle that it touches gets better. Local.
void polish_surface(SurfaceEditor& editor);

}  // namespace tessera::surface
