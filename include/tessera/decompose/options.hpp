// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/types.hpp"

namespace tessera::decompose {

/// @brief Options of the decomposition; table `[decompose]` of a case file.
struct DecomposeOptions {
  /// Wanted number of subdomains, >= 1; 0 stands for "auto". A request: at least one a material, at
  /// most one a coarse tet, and repair may split further.
  LocalIndex subdomains = 0;
  LocalIndex least = 1;  ///< "auto" gives no fewer, if there are as many coarse tets.
  LocalIndex parts = 0;  ///< output.parts: parts that consist of whole subdomains; 0: none.

  friend bool operator==(const DecomposeOptions&, const DecomposeOptions&) = default;
};

}  // namespace tessera::decompose
