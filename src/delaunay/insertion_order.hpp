// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {

// Rows of points along a space-filling curve; of points at one place only the lowest row. The
// positions in this order are a function of the set of positions.
[[nodiscard]] std::vector<LocalIndex> along_curve(std::span<const double> xyz);

// Sorts rows of points, which come along the curve, by the rounds in which they are put in, each
// some times as many as the one before: walks stay short, and tets that later points destroy stay
// few. @cite amenta2003
void sort_by_round(std::span<const Vec3> points, std::vector<LocalIndex>& rows);

}  // namespace tessera::delaunay
