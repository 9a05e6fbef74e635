// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/lattice.hpp"

namespace tessera::refine {

/// @brief Options of the refinement; table `[refine]` of a case file.
struct RefineOptions {
  /// L >= 0: every coarse edge is split into 2^L. Where sizes are wanted (table `[size]`), the most
  /// levels that an edge may have. -1: not given.
  int levels = -1;

  friend bool operator==(const RefineOptions&, const RefineOptions&) = default;
};

/// @brief The levels as they are if none are given: 1, or as many as needed where sizes are wanted.
/// Local.
[[nodiscard]] inline int levels_of(const RefineOptions& options, bool sizes_are_wanted)
{
  if (options.levels >= 0) return options.levels;
  return sizes_are_wanted ? mesh::lattice::kMaxLevels : 1;
}

}  // namespace tessera::refine
