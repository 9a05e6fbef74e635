// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/surface_editor.hpp"

namespace tessera::coarse {

/// @brief Divides every piece of a curve, between two vertices that stay in their places, into the
/// whole number of edges that fits the wanted lengths best, all equally long in parts of these.
/// Local.
///
/// Vertices come to the places of the division, and others go. One that cannot go without spoiling
/// triangles stays.
void divide_curves(SurfaceEditor& editor);

}  // namespace tessera::coarse
