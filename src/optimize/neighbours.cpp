// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/neighbours.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "optimize/corners.hpp"

namespace tessera::optimize {
namespace {

// Whether two corners see one triangle from both sides.
bool are_opposite(const std::vector<LocalIndex>& tet_vertices, Corner corner, Corner other)
{
  const auto [a, b, c] = face_vertices(tet_vertices, corner);
  const auto [d, e, f] = face_vertices(tet_vertices, other);
  return mesh::sorted_triangle(a, b, c) == mesh::sorted_triangle(d, e, f)
         && mesh::is_even_triangle(a, b, c) != mesh::is_even_triangle(d, e, f);
}

}  // namespace

void require_neighbours(const std::vector<LocalIndex>& tet_vertices,
                        const std::vector<LocalIndex>& tet_neighbours)
{
  const auto num_corners = static_cast<Corner>(tet_vertices.size());
  for (Corner corner = 0; corner < num_corners; ++corner) {
    const Corner other = tet_neighbours[at(corner)];
    if (other == kNoIndex) continue;
    if (other < 0 || other >= num_corners || tet_neighbours[at(other)] != corner
        || !are_opposite(tet_vertices, corner, other)) {
      throw MeshError(fmt::format("tet {} has a wrong neighbour opposite to its corner {}",
                                  tet_of(corner), corner & 3));
    }
  }
}

}  // namespace tessera::optimize
