// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "tessera/fill/kernel.hpp"
#include "tessera/fill/options.hpp"

namespace tessera::fill {

/// @brief What NETGEN begins a fill with.
///
/// The children of the coarse tets fill the skin already, so there is nothing that could fail.
/// Their points are the same however the mesh is cut, so the fill does not depend on the cut.
///
/// Measured on shaft (L = 2, 1 / 64 subdomains, seams improved): tets, mean of the mean ratio, CPU
/// time to fill.
///   children   157.6 / 156.2 k, 0.870 / 0.865, 6.6 / 6.4 s
///   skin       158.1 / 135.8 k, 0.866 / 0.846, 26.1 / 17.5 s
enum class FillStart : int { children, skin };
[[nodiscard]] constexpr FillStart last_value(FillStart /*type*/) { return FillStart::skin; }

/// @brief One try at a subdomain, as subdomain::fill_subdomain() makes it; a fallback_sequence() is
/// made of these. By default it is the main way: NETGEN swaps edges and faces of
/// the children of the coarse tets, then our own optimiser goes over them.
struct FillTry {
  KernelKind kernel = KernelKind::netgen;
  FillStart start = FillStart::children;  ///< Of NETGEN; the others have no other.
  KernelSettings settings{};              ///< Of NETGEN; the others have none.
  bool split_corners = false;             ///< splits_corners().

  static auto fields(auto& self)
  {
    return std::tie(self.kernel, self.start, self.settings, self.split_corners);
  }
};

}  // namespace tessera::fill
