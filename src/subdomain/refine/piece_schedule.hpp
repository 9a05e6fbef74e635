// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/optimize/schedule.hpp"

namespace tessera::subdomain {

/// @brief What our optimiser does with the tets of a piece, or of a seam region.
/// @param[in] divides Tets with several outer triangles are divided, once swaps have done what they
/// can.
/// @param[in] rounds How often all other steps are done, >= 1.
[[nodiscard]] optimize::Schedule piece_schedule(bool divides, int rounds = 1);

}  // namespace tessera::subdomain
