// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/model/assembly.hpp"

#include "cad/cad_file.hpp"
#include "cad/heal/fuse.hpp"

namespace tessera::cad {

/// @brief Closes gaps between solids: fuses them once more if some come nearer to each other than
/// `gap` without touching there, and takes that if they then have more faces in common.
/// @param[in,out] fused The solids, as they touch by themselves.
/// @return The gaps that were closed.
[[nodiscard]] std::vector<model::ClosedGap> close_gaps(const Shapes& solids, double gap,
                                                       const ShapeNames& names, FusedSolids& fused);

}  // namespace tessera::cad
