// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/tets_behind.hpp"

#include "tessera/migrate/tet_neighbours.hpp"

namespace tessera::formats {

std::vector<LocalIndex> tets_behind(LocalIndex num_points,
                                    const std::vector<LocalIndex>& tet_points)
{
  migrate::MeshBlock block;
  block.vertex_ids.resize(at(num_points));
  block.tet_ids.resize(tet_points.size() / 4);
  block.tet_vertices = tet_points;
  return migrate::tets_behind_faces(block);
}

}  // namespace tessera::formats
