// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/files/line_edges.hpp"

#include <map>

namespace tessera::subdomain {
namespace {

void set_owners(const mesh::Skeleton& skeleton, const mesh::Decomposition& decomposition,
                std::vector<LineEdge>& lines)
{
  std::map<LocalIndex, LocalIndex*> owner_of;
  for (LineEdge& line : lines) owner_of.emplace(line.edge, &line.owner);
  const auto material = [&](LocalIndex subdomain) {
    return subdomain == kNoIndex ? kNoIndex : decomposition.subdomain_material[at(subdomain)];
  };
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const LocalIndex* sides = &skeleton.triangle_subdomains[2 * at(t)];
    if (material(sides[0]) == material(sides[1])) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      const auto owner = owner_of.find(skeleton.triangle_edges[3 * at(t) + side]);
      if (owner == owner_of.end()) continue;
      for (const LocalIndex subdomain : {sides[0], sides[1]}) {
        const bool is_lower = *owner->second == kNoIndex || subdomain < *owner->second;
        if (subdomain != kNoIndex && is_lower) *owner->second = subdomain;
      }
    }
  }
}

}  // namespace

std::vector<LineEdge> edges_on_lines(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                                     const mesh::Decomposition& decomposition)
{
  std::vector<LineEdge> found;
  const std::map<LocalIndex, LocalIndex> lines = mesh::lines_by_curve(coarse);
  if (lines.empty()) return found;
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    const auto line = lines.find(skeleton.edge_curve[at(e)]);
    if (line != lines.end()) found.push_back({e, line->second});
  }
  set_owners(skeleton, decomposition, found);
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

void add_line_edges(const PartitionedMesh& cut, mesh::Piece& piece)
{
  const mesh::HostLayout hosts(cut.skeleton);
  std::vector<LineEdge> owned;
  std::map<LocalIndex, LocalIndex> num_points;  // Inside of an edge.
  for (const LineEdge& line : cut.lines) {
    if (line.owner != piece.subdomain) continue;
    owned.push_back(line);
    num_points[hosts.edge(line.edge)] = 0;
  }
  if (owned.empty()) return;
  std::map<mesh::HostPoint, LocalIndex> vertex_named;
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const mesh::HostPoint name = piece.skin_point(v);
    vertex_named.emplace(name, v);
    const auto edge = num_points.find(name.host);
    if (edge != num_points.end()) ++edge->second;
  }
  for (const LineEdge& line : owned) {
    const LocalIndex n = num_points.at(hosts.edge(line.edge)) + 1;
    const std::vector<mesh::HostPoint> points = points_along(cut.skeleton, hosts, line.edge, n);
    for (std::size_t k = 1; k < points.size(); ++k) {
      piece.line_vertices.push_back(vertex_named.at(points[k - 1]));
      piece.line_vertices.push_back(vertex_named.at(points[k]));
      piece.line.push_back(line.line);
    }
  }
}

}  // namespace tessera::subdomain
