// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/surface/coarse_surface.hpp"

namespace tessera::coarse {

/// @brief Makes the tets of a domain better and fewer: vertices off its skin are moved and merged,
/// edges and faces swapped. The skin stays. A volume mesher makes a third too many, and the
/// schedule collapses more than that of a fill.
///
/// No tet keeps two faces on one patch, if that can be: where the patch is smooth, the children of
/// such a tet would become flat (Repair::illegal_tets). At last vertices are put into the worst
/// tets (Repair::worst_tets).
/// @param[in] skin That the tets fill.
/// @note Local. @throws MeshError as optimize::optimize().
[[nodiscard]] surface::DomainTets optimize_domain(const surface::DomainSkin& skin,
                                                  surface::DomainTets tets);

}  // namespace tessera::coarse
