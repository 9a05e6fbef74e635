// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csg.hpp>

#include "netgen/csg/cut.hpp"

namespace tessera::netgen {

/// @brief Adds points where edges of two solids cross on a surface that both have: traces of two
/// cuts, or of a cut and an edge of the other solid. NETGEN looks for corners solid by solid, and
/// for crossings only where both edges are straight.
/// @param[in] box Around the model.
void add_crossings(::netgen::CSGeometry& geometry, const CutObjects& objects,
                   const ::netgen::Box<3>& box);

}  // namespace tessera::netgen
