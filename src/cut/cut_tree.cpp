// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/cut/cut_tree.hpp"

#include <cstddef>

namespace tessera::cut {

LocalIndex CutTree::part_of(LocalIndex solid, const Vec3& point) const
{
  const CutNode* node = &nodes.at(static_cast<std::size_t>(solid_root.at(at(solid))));
  while (node->part == kNoIndex) {
    const bool is_below = dot(node->plane.normal, point) < node->plane.offset;
    node = &nodes.at(at(is_below ? node->below : node->above));
  }
  return node->part;
}

}  // namespace tessera::cut
