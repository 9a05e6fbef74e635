// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "tessera/improve/optimizer.hpp"

namespace tessera::subdomain {

/// @brief The module `optimize` as an optimiser of seam regions, with the steps of a fill.
/// @param[in] split_corners No tet gets a second face on the geometry.
[[nodiscard]] std::unique_ptr<improve::Optimizer> make_seam_optimizer(bool split_corners);

}  // namespace tessera::subdomain
