// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/seam_angles.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"

namespace tessera::decompose {
namespace {

using Edge = std::pair<LocalIndex, LocalIndex>;

std::vector<Edge> edges_of_seams(const TetGraph& graph, const mesh::Decomposition& decomposition)
{
  std::vector<Edge> edges;
  for (const mesh::TriangleTets& triangle : graph.triangles) {
    if (!is_seam(graph, decomposition, triangle)) continue;
    const auto& [a, b, c] = triangle.vertices;
    edges.insert(edges.end(), {{a, b}, {a, c}, {b, c}});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double dihedral(const mesh::CoarseMesh& mesh, LocalIndex t, std::size_t edge)
{
  return mesh::dihedral_angle(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t), edge);
}

// The angle that one tet adds to the wedge of its subdomain at an edge.
struct Share {
  std::size_t edge;
  LocalIndex subdomain;
  double angle;
  [[nodiscard]] bool is_same_wedge(const Share& other) const
  {
    return edge == other.edge && subdomain == other.subdomain;
  }
};

std::vector<Share> shares_at_seams(const TetGraph& graph, const mesh::Decomposition& decomposition)
{
  const std::vector<Edge> edges = edges_of_seams(graph, decomposition);
  std::vector<bool> is_at_seam(static_cast<std::size_t>(graph.num_vertices()), false);
  for (const auto& [a, b] : edges) {
    is_at_seam[static_cast<std::size_t>(a)] = true;
    is_at_seam[static_cast<std::size_t>(b)] = true;
  }
  std::vector<Share> shares;
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const auto vertices = graph.vertices(t);
    for (std::size_t edge = 0; edge < mesh::kTetEdgeCorners.size(); ++edge) {
      const Edge ends = std::minmax(vertices[mesh::kTetEdgeCorners[edge][0]],
                                    vertices[mesh::kTetEdgeCorners[edge][1]]);
      const bool may_be = is_at_seam[static_cast<std::size_t>(ends.first)]
                          && is_at_seam[static_cast<std::size_t>(ends.second)];
      if (!may_be) continue;
      const auto found = std::lower_bound(edges.begin(), edges.end(), ends);
      if (found == edges.end() || *found != ends) continue;
      shares.push_back({static_cast<std::size_t>(found - edges.begin()),
                        decomposition.tet_subdomain[static_cast<std::size_t>(t)],
                        dihedral(*graph.mesh, t, edge)});
    }
  }
  return shares;
}

}  // namespace

bool is_seam(const TetGraph& graph, const mesh::Decomposition& decomposition,
             const mesh::TriangleTets& triangle)
{
  if (triangle.tets[1] == kNoIndex) return false;
  const auto a = static_cast<std::size_t>(triangle.tets[0]);
  const auto b = static_cast<std::size_t>(triangle.tets[1]);
  return decomposition.tet_subdomain[a] != decomposition.tet_subdomain[b]
         && graph.mesh->tet_material[a] == graph.mesh->tet_material[b];
}

double min_seam_dihedral_deg(const TetGraph& graph, const mesh::Decomposition& decomposition)
{
  std::vector<Share> shares = shares_at_seams(graph, decomposition);
  std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.subdomain < b.subdomain;
  });
  double smallest = std::numbers::pi;
  for (std::size_t i = 0; i < shares.size();) {
    const Share& first = shares[i];
    double sum = 0.0;
    for (; i < shares.size() && first.is_same_wedge(shares[i]); ++i) sum += shares[i].angle;
    smallest = std::min(smallest, sum);
  }
  return smallest * 180.0 / std::numbers::pi;
}

}  // namespace tessera::decompose
