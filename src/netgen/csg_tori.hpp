// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csg.hpp>

namespace tessera::netgen {

/// @brief Makes sizes on tori follow their radius. NETGEN 6.2 takes 2 / r^2 for the curvature, with
/// r the small radius in the file's unit: with r = 0.1 edges are ten times shorter than with r = 1
/// at the same shape, and the surface hardly ever ends; with r = 10 they are ten times longer.
/// Local.
void mend_tori(::netgen::CSGeometry& geometry);

}  // namespace tessera::netgen
