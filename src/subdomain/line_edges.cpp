// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/line_edges.hpp"

#include <map>

namespace tessera::subdomain {

std::vector<LineEdge> edges_on_lines(const mesh::Skeleton& skeleton, const mesh::CoarseMesh& coarse)
{
  std::vector<LineEdge> found;
  const std::map<LocalIndex, LocalIndex> lines = mesh::lines_by_curve(coarse);
  if (lines.empty()) return found;
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    const auto line = lines.find(skeleton.edge_curve[at(e)]);
    if (line != lines.end()) found.push_back({e, line->second});
  }
  return found;
}

std::vector<mesh::HostPoint> points_along(const mesh::Skeleton& skeleton,
                                          const mesh::HostLayout& hosts, LocalIndex edge,
                                          LocalIndex n)
{
  std::vector<mesh::HostPoint> points{{hosts.vertex(skeleton.edge_vertices[2 * at(edge)]), 0}};
  for (LocalIndex k = 0; k + 1 < n; ++k) points.push_back({hosts.edge(edge), k});
  points.push_back({hosts.vertex(skeleton.edge_vertices[2 * at(edge) + 1]), 0});
  return points;
}

void add_line_edges(const mesh::Skeleton& skeleton, const mesh::CoarseMesh& coarse,
                    mesh::Piece& piece)
{
  const mesh::HostLayout hosts(skeleton);
  std::vector<LineEdge> owned;
  std::map<mesh::HostPoint, LocalIndex> vertex_named;
  std::map<LocalIndex, LocalIndex> num_points;  // Inside of an edge.
  for (const LineEdge& line : edges_on_lines(skeleton, coarse)) {
    if (skeleton.edge_owner[at(line.edge)] != piece.subdomain) continue;
    owned.push_back(line);
    num_points[hosts.edge(line.edge)] = 0;
  }
  if (owned.empty()) return;
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const mesh::HostPoint name = piece.skin_point(v);
    vertex_named.emplace(name, v);
    const auto edge = num_points.find(name.host);
    if (edge != num_points.end()) ++edge->second;
  }
  for (const LineEdge& line : owned) {
    const LocalIndex n = num_points.at(hosts.edge(line.edge)) + 1;
    const std::vector<mesh::HostPoint> points = points_along(skeleton, hosts, line.edge, n);
    for (std::size_t k = 1; k < points.size(); ++k) {
      piece.line_vertices.push_back(vertex_named.at(points[k - 1]));
      piece.line_vertices.push_back(vertex_named.at(points[k]));
      piece.line.push_back(line.line);
    }
  }
}

}  // namespace tessera::subdomain
