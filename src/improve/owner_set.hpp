// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// A set of owners of a region: bit i is owner i.
using OwnerSet = std::uint64_t;

inline constexpr std::size_t kMaxOwners = 64;

[[nodiscard]] inline OwnerSet only(LocalIndex owner) { return OwnerSet{1} << owner; }

[[nodiscard]] inline bool contains(OwnerSet set, LocalIndex owner)
{
  return (set & only(owner)) != 0;
}

[[nodiscard]] OwnerSet all_owners(const RegionMesh& mesh);

// Which owners hold each fixed vertex.
[[nodiscard]] std::vector<OwnerSet> holders_of_fixed(const RegionMesh& mesh);

// Which owners may have each tet: those that hold all of its fixed vertices, and that may be behind
// its boundary triangles.
// @param[in] triangle_tet The tet behind each boundary triangle.
[[nodiscard]] std::vector<OwnerSet> allowed_owners(const RegionMesh& mesh, const TetMesh& tets,
                                                   const std::vector<LocalIndex>& triangle_tet);

}  // namespace tessera::improve
