// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/lattice.hpp"

namespace tessera::refine {

inline constexpr int kMostLevels = mesh::lattice::kMaxLevels;

/// @brief Options of the refinement; table `[refine]` of a case file.
struct RefineOptions {
  /// L >= 0: every coarse edge is split into 2^L. Where sizes are wanted (table `[size]`), the most
  /// levels that an edge may have.
  int levels = 1;

  friend bool operator==(const RefineOptions&, const RefineOptions&) = default;
};

}  // namespace tessera::refine
