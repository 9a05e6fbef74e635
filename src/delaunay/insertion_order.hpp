// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::delaunay {

// Rows of points in the order in which they are put in; of points at one place only the lowest row.
// The positions in this order are a function of the set of positions.
//
// Points come in rounds, each some times as many as the one before, and in each along a
// space-filling curve: walks stay short, and tets that later points destroy stay few.
// @cite amenta2003
[[nodiscard]] std::vector<LocalIndex> insertion_order(std::span<const double> xyz);

}  // namespace tessera::delaunay
