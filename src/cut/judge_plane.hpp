// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/cut/choose_planes.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// A clearance that is as good as any larger one.
inline constexpr double kLargestClearance = 4.0;

/// @brief How a plane meets a part; node, solid and is_given are left to the caller.
[[nodiscard]] PlaneJudgement judge_plane(const PartSurface& part, const Plane& plane,
                                         double coarse_size);

}  // namespace tessera::cut
