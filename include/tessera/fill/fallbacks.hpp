// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tessera/fill/fill_try.hpp"
#include "tessera/fill/options.hpp"

namespace tessera::fill {

/// @brief The tries of one subdomain, best first.
///
/// For NETGEN:
/// - from the children of the coarse tets;
/// - from the skin alone;
/// - the same with another order of points, since an inner cavity or a bad start can depend on it;
/// - relaxed grading with little optimisation, in a third order.
///
/// For our own optimiser: from the children, folded or not.
///
/// The last try is always subdivision. It cannot fail on a skin whose coarse tets have positive
/// children.
[[nodiscard]] std::vector<FillTry> fallback_sequence(const FillOptions& options, KernelKind kernel);

/// @brief The kernel that the case wants for each of the given materials (of subdomains, of tets).
/// Local.
/// @param[in] material_names Names of the model's materials, material m at m - 1.
/// @param[in] materials From 1.
/// @throws ConfigError if a region names a material that the model does not have.
[[nodiscard]] std::vector<KernelKind> kernels_of(const FillOptions& options,
                                                 const std::vector<std::string>& material_names,
                                                 std::span<const LocalIndex> materials);

}  // namespace tessera::fill
