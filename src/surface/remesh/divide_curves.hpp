// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/editor.hpp"

namespace tessera::surface {

/// @brief Divides curves into edges of the wanted lengths. Local.
///
/// A piece of a curve is what lies between two vertices that stay in their places. It gets the
/// whole number of edges that fits best. All of them are equally long in parts of the wanted
/// length. Vertices come to the places of the division, and others go. One that cannot go without
/// spoiling triangles stays.
void divide_curves(SurfaceEditor& editor);

}  // namespace tessera::surface
