// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/fill/kernel.hpp"
#include "tessera/fill/options.hpp"

namespace tessera::fill {

/// @brief The tries of one subdomain, best first: as asked; the same with another order of points
/// (an inner cavity or a bad start can depend on it); relaxed grading with little optimisation,
/// twice with different orders of points.
[[nodiscard]] std::vector<FillTry> retry_ladder(const FillOptions& options);

}  // namespace tessera::fill
