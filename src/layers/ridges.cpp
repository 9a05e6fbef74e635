// SPDX-License-Identifier: BSD-3-Clause
#include "layers/ridges.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tessera/mesh/image_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::layers {
namespace {

using Edge = std::array<LocalIndex, 2>;

bool is_sharp(const mesh::CoarseMesh& mesh, const Edge& edge, const SurfaceTriangle& a,
              const SurfaceTriangle& b)
{
  if (!a.is_wall || !b.is_wall) return false;
  const LocalIndex other = *std::ranges::find_if(
      b.vertices, [&](LocalIndex v) { return std::ranges::count(edge, v) == 0; });
  return is_ridge(a.normal, b.normal, mesh.position(other) - mesh.position(edge[0]));
}

// Puts vertices into edges of tets.
class Divider {
 public:
  explicit Divider(mesh::CoarseMesh& mesh) : mesh_(mesh), tets_at_(at(mesh.num_vertices()))
  {
    for (std::size_t c = 0; c < mesh.tet_vertices.size(); ++c) {
      tets_at_[at(mesh.tet_vertices[c])].push_back(static_cast<LocalIndex>(c / 4));
    }
  }

  void divide(const Edge& edge)
  {
    const LocalIndex middle = mesh_.num_vertices();
    const Vec3 place = midpoint(mesh_.position(edge[0]), mesh_.position(edge[1]));
    mesh_.vertex_xyz.insert(mesh_.vertex_xyz.end(), place.begin(), place.end());
    tets_at_.emplace_back();
    const std::vector<LocalIndex> around = tets_at_[at(edge[0])];
    for (const LocalIndex tet : around) {
      if (std::ranges::count(mesh_.tet(tet), edge[1]) > 0) divide_tet(tet, edge, middle);
    }
  }

 private:
  // The tet keeps the first end of the edge; a new one has the other end.
  void divide_tet(LocalIndex tet, const Edge& edge, LocalIndex middle)
  {
    const LocalIndex added = mesh_.num_tets();
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex v = mesh_.tet_vertices[4 * at(tet) + c];
      mesh_.tet_vertices.push_back(v == edge[0] ? middle : v);
      if (v == edge[1]) {
        mesh_.tet_vertices[4 * at(tet) + c] = middle;
        std::erase(tets_at_[at(v)], tet);
      }
      if (v != edge[0]) tets_at_[at(v)].push_back(added);
    }
    mesh_.tet_material.push_back(LocalIndex{mesh_.tet_material[at(tet)]});
    tets_at_[at(middle)].push_back(tet);
    tets_at_[at(middle)].push_back(added);
  }

  mesh::CoarseMesh& mesh_;
  std::vector<std::vector<LocalIndex>> tets_at_;  // Of each vertex.
};

// Vertices that no wake may go over: on walls, and on periodic sides.
std::vector<char> blocked_vertices(const mesh::CoarseMesh& mesh, const WallSurface& walls)
{
  std::vector<char> is_blocked(at(mesh.num_vertices()), 0);
  for (const WallVertex& vertex : walls.vertices) is_blocked[at(vertex.vertex)] = 1;
  for (const mesh::ImageEdge& edge : mesh::image_edges(mesh, mesh::ImageKind::periodic)) {
    for (std::size_t end = 0; end < 2; ++end) {
      is_blocked[at(edge.from[end])] = is_blocked[at(edge.to[end])] = 1;
    }
  }
  return is_blocked;
}

std::set<Edge> edges_on_surface(const mesh::CoarseMesh& mesh)
{
  std::set<Edge> edges;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) edges.insert(mesh::sorted_edge(v[c], v[(c + 1) % 3]));
  }
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex* v = &mesh.segment_vertices[2 * at(s)];
    edges.insert(mesh::sorted_edge(v[0], v[1]));
  }
  return edges;
}

}  // namespace

std::vector<Ridge> find_ridges(const mesh::CoarseMesh& mesh, const WallSurface& walls)
{
  std::map<Edge, std::vector<const SurfaceTriangle*>> sides;
  for (const SurfaceTriangle& triangle : walls.triangles) {
    const auto& v = triangle.vertices;
    for (std::size_t c = 0; c < 3; ++c) {
      sides[mesh::sorted_edge(v[c], v[(c + 1) % 3])].push_back(&triangle);
    }
  }
  std::vector<Ridge> ridges;
  for (const auto& [edge, beside] : sides) {
    if (beside.size() != 2 || !is_sharp(mesh, edge, *beside[0], *beside[1])) continue;
    ridges.push_back({edge, unit(-1.0 * (beside[0]->normal + beside[1]->normal))});
  }
  return ridges;
}

void divide_at_ridges(const WallSurface& walls, mesh::CoarseMesh& mesh)
{
  std::vector<char> is_on_ridge(at(mesh.num_vertices()), 0);
  for (const Ridge& ridge : find_ridges(mesh, walls)) {
    for (const LocalIndex v : ridge.edge) is_on_ridge[at(v)] = 1;
  }
  const std::set<Edge> on_surface = edges_on_surface(mesh);
  const std::vector<char> is_blocked = blocked_vertices(mesh, walls);
  const auto is_its = [&](LocalIndex v) { return is_blocked[at(v)] != 0; };
  std::set<Edge> to_divide;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = mesh.tet(t);
    if (std::ranges::none_of(tet, [&](LocalIndex v) { return is_on_ridge[at(v)] != 0; })) continue;
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      const Edge edge = mesh::sorted_edge(tet[a], tet[b]);
      if (std::ranges::all_of(edge, is_its) && !on_surface.contains(edge)) {
        to_divide.insert(edge);
      }
    }
  }
  Divider divider(mesh);
  for (const Edge& edge : to_divide) divider.divide(edge);
}

}  // namespace tessera::layers
