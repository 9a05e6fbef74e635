// SPDX-License-Identifier: BSD-3-Clause
#include "support/surfaces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tessera/base/vec3.hpp"

namespace tessera::testing {

SurfaceTopology topology_of(const std::vector<LocalIndex>& triangle_vertices)
{
  std::map<std::pair<LocalIndex, LocalIndex>, int> directed;
  std::set<std::pair<LocalIndex, LocalIndex>> edges;
  for (std::size_t t = 0; t < triangle_vertices.size(); t += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex a = triangle_vertices[t + c];
      const LocalIndex b = triangle_vertices[t + (c + 1) % 3];
      ++directed[{a, b}];
      edges.insert(std::minmax(a, b));
    }
  }
  const std::set<LocalIndex> used(triangle_vertices.begin(), triangle_vertices.end());
  SurfaceTopology topology;
  topology.num_used_vertices = static_cast<LocalIndex>(used.size());
  topology.euler = static_cast<LocalIndex>(used.size() + triangle_vertices.size() / 3)
                   - static_cast<LocalIndex>(edges.size());
  for (const auto& [edge, times] : directed) {
    const auto opposite = directed.find({edge.second, edge.first});
    const bool matched = times == 1 && opposite != directed.end() && opposite->second == 1;
    topology.num_unmatched_edges += matched ? 0 : 1;
  }
  return topology;
}

double volume_inside(std::span<const double> vertex_xyz,
                     const std::vector<LocalIndex>& triangle_vertices)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < triangle_vertices.size(); t += 3) {
    sum += dot(point_at(vertex_xyz, triangle_vertices[t]),
               cross(point_at(vertex_xyz, triangle_vertices[t + 1]),
                     point_at(vertex_xyz, triangle_vertices[t + 2])))
           / 6.0;
  }
  return sum;
}

}  // namespace tessera::testing
