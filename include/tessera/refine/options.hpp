// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::refine {

/// @brief Options of the refinement; table `[refine]` of a case file.
struct RefineOptions {
  int levels = 1;  ///< L >= 0: every coarse edge is split into 2^L.

  friend bool operator==(const RefineOptions&, const RefineOptions&) = default;
};

}  // namespace tessera::refine
