// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/editor.hpp"

namespace tessera::surface {

/// @brief Splits edges of curves that divide_curves() would cut into many, each at the place of the
/// division that is nearest to its middle. Local.
///
/// All vertices that an edge gets at once hang on one vertex: a fan. In a narrow strip flips cannot
/// open a large one, and splits make needles of it without end: a rail of 350 mm with strips of
/// 0.3 mm had millions of triangles. So edges are halved until fans are small, and the caller
/// flips edges between.
/// @return Whether there were such edges.
bool halve_long_edges(SurfaceEditor& editor);

/// @brief Divides curves into edges of the wanted lengths. Local.
///
/// A piece of a curve is what lies between two vertices that stay in their places. It gets the
/// whole number of edges that fits best. All of them are equally long in parts of the wanted
/// length. Vertices come to the places of the division, and others go. One that cannot go without
/// spoiling triangles stays.
void divide_curves(SurfaceEditor& editor);

}  // namespace tessera::surface
