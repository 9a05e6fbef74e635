// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/skin.hpp"

namespace tessera::subdomain {

// Gives a piece the triangles on the geometry that it owns: all on the outside, and those between
// two materials if it is the lower side.
// @param[in] triangle_tet The tet behind each triangle of the skin.
void add_boundary(const mesh::Skin& skin, const mesh::Skeleton& skeleton,
                  const std::vector<LocalIndex>& triangle_tet, mesh::Piece& piece);

}  // namespace tessera::subdomain
