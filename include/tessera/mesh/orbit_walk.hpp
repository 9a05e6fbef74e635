// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/orbits.hpp"

namespace tessera::mesh {

/// @brief Walks along links, both ways, from the lowest row of each orbit to all others of it.
/// Calls `visit(here, there, link)` once for each row that is reached. Local; linear.
template <class Visit>
void walk_orbits(LocalIndex num_rows, std::span<const ImageLink> links, const Visit& visit)
{
  std::vector<LocalIndex> ends;
  for (const ImageLink& link : links) ends.insert(ends.end(), {link.from, link.to});
  const IndexLists links_at = rows_by_key(ends, num_rows, 2);
  std::vector<bool> is_reached(at(num_rows), false);
  for (LocalIndex base = 0; base < num_rows; ++base) {
    if (is_reached[at(base)]) continue;
    is_reached[at(base)] = true;
    std::vector<LocalIndex> reached{base};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const LocalIndex here = reached[next];
      for (const LocalIndex l : links_at[here]) {
        const ImageLink& link = links[at(l)];
        const LocalIndex there = link.from == here ? link.to : link.from;
        if (is_reached[at(there)]) continue;
        is_reached[at(there)] = true;
        reached.push_back(there);
        visit(here, there, link);
      }
    }
  }
}

}  // namespace tessera::mesh
