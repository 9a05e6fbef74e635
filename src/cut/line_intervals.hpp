// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::cut {

/// Where the border of a cap crosses a line.
struct LineCrossing {
  double place = 0.0;           ///< Along the line.
  LocalIndex point = kNoIndex;  ///< What stands there; breaks ties.
  bool goes_below = false;      ///< The border comes from above the line.
};

/// @brief Calls visit(from, to) for the pieces of the line inside the cap, between points of
/// crossings that follow each other, such that those pieces close the border of what is below.
/// Exact also where the border crosses itself: pieces that count twice come twice.
template <class Visit>
void for_each_interval(std::vector<LineCrossing> crossings, const Visit& visit)
{
  std::ranges::sort(crossings, {}, [](const LineCrossing& c) {
    return std::tuple(c.place, c.point, c.goes_below);
  });
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].goes_below ? -1 : 1;
    for (int n = 0; n < winding; ++n) visit(crossings[i].point, crossings[i + 1].point);
    for (int n = 0; n < -winding; ++n) visit(crossings[i + 1].point, crossings[i].point);
  }
}

}  // namespace tessera::cut
