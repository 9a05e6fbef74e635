// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/euler.hpp"

#include <algorithm>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::verify {
namespace {

// V - E + F - T of tets whose vertices are dense.
GlobalIndex characteristic(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices)
{
  const auto num_triangles = mesh::number_rows(mesh::faces_of_tets(tet_vertices)).rows.size();
  return num_vertices - mesh::count_edges(tet_vertices, num_vertices)
         + static_cast<GlobalIndex>(num_triangles)
         - static_cast<GlobalIndex>(tet_vertices.size() / 4);
}

}  // namespace

std::vector<GlobalIndex> euler_characteristics(std::span<const LocalIndex> tet_vertices,
                                               std::span<const LocalIndex> tet_part)
{
  LocalIndex num_parts = 0;
  for (const LocalIndex part : tet_part) num_parts = std::max(num_parts, part + 1);
  LocalIndex num_vertices = 0;
  for (const LocalIndex v : tet_vertices) num_vertices = std::max(num_vertices, v + 1);
  const IndexLists tets_of = rows_by_key(tet_part, num_parts);

  std::vector<GlobalIndex> euler;
  std::vector<LocalIndex> part_of(at(num_vertices), kNoIndex);  // The last one that had the vertex,
  std::vector<LocalIndex> number(at(num_vertices));             // and its number there.
  std::vector<LocalIndex> own;
  for (LocalIndex part = 0; part < num_parts; ++part) {
    own.clear();
    LocalIndex num_own = 0;
    for (const LocalIndex tet : tets_of[part]) {
      for (const LocalIndex v : tet_vertices.subspan(4 * at(tet), 4)) {
        if (part_of[at(v)] != part) number[at(v)] = num_own++;
        part_of[at(v)] = part;
        own.push_back(number[at(v)]);
      }
    }
    euler.push_back(characteristic(own, num_own));
  }
  return euler;
}

}  // namespace tessera::verify
