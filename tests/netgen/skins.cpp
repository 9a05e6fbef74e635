// SPDX-License-Identifier: BSD-3-Clause
#include "skins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::testing {
namespace {

void append(std::vector<double>& xyz, const Vec3& p) { xyz.insert(xyz.end(), p.begin(), p.end()); }

Vec3 corner(const fill::FillInput& skin, std::size_t at)
{
  return point_at(std::span(skin.vertex_xyz), skin.triangle_vertices[at]);
}

void add_sample(fill::FillInput& skin, const Vec3& p, double h)
{
  append(skin.size_xyz, p);
  skin.size_h.push_back(h);
}

// One new vertex in the middle of every edge, pushed onto the unit sphere; four triangles for one.
void refine_on_sphere(fill::FillInput& skin)
{
  std::map<std::pair<LocalIndex, LocalIndex>, LocalIndex> middle_of;
  const auto middle = [&](LocalIndex a, LocalIndex b) {
    const auto next = static_cast<LocalIndex>(skin.vertex_xyz.size() / 3);
    const auto [entry, is_new] = middle_of.emplace(std::minmax(a, b), next);
    if (is_new) {
      const Vec3 p = midpoint(point_at(std::span<const double>(skin.vertex_xyz), a),
                              point_at(std::span<const double>(skin.vertex_xyz), b));
      append(skin.vertex_xyz, (1.0 / norm(p)) * p);
    }
    return entry->second;
  };
  std::vector<LocalIndex> finer;
  for (std::size_t t = 0; t < skin.triangle_vertices.size(); t += 3) {
    const LocalIndex a = skin.triangle_vertices[t];
    const LocalIndex b = skin.triangle_vertices[t + 1];
    const LocalIndex c = skin.triangle_vertices[t + 2];
    const LocalIndex ab = middle(a, b);
    const LocalIndex bc = middle(b, c);
    const LocalIndex ca = middle(c, a);
    finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  skin.triangle_vertices = std::move(finer);
}

fill::FillInput icosahedron()
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  fill::FillInput skin;
  const std::array<Vec3, 12> vertices{{{-1, g, 0},
                                       {1, g, 0},
                                       {-1, -g, 0},
                                       {1, -g, 0},
                                       {0, -1, g},
                                       {0, 1, g},
                                       {0, -1, -g},
                                       {0, 1, -g},
                                       {g, 0, -1},
                                       {g, 0, 1},
                                       {-g, 0, -1},
                                       {-g, 0, 1}}};
  for (const Vec3& p : vertices) append(skin.vertex_xyz, (1.0 / norm(p)) * p);
  skin.triangle_vertices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                            4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                            6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  return skin;
}

}  // namespace

fill::FillInput cube_skin(int n)
{
  const mesh::CoarseMesh cube = kuhn_cube(n);
  fill::FillInput skin;
  std::map<LocalIndex, LocalIndex> skin_vertex;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(cube.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const auto tet = cube.tet(triangle.tets[0]);
    for (const std::size_t c :
         mesh::kTetFaceCorners[static_cast<std::size_t>(triangle.corners[0])]) {
      const auto next = static_cast<LocalIndex>(skin_vertex.size());
      const auto [entry, is_new] = skin_vertex.emplace(tet[c], next);
      if (is_new) append(skin.vertex_xyz, cube.position(tet[c]));
      skin.triangle_vertices.push_back(entry->second);
    }
  }
  const double h = mean_edge(skin);
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    Vec3 centroid{};
    for (const LocalIndex v : cube.tet(t)) centroid = centroid + 0.25 * cube.position(v);
    add_sample(skin, centroid, h);
  }
  return skin;
}

fill::FillInput sphere_skin(int levels)
{
  fill::FillInput skin = icosahedron();
  for (int level = 0; level < levels; ++level) refine_on_sphere(skin);
  const double h = mean_edge(skin);
  const int n = static_cast<int>(1.0 / h) + 1;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      for (int k = -n; k <= n; ++k) {
        const Vec3 p{i * h, j * h, k * h};
        if (norm(p) < 1.0) add_sample(skin, p, h);
      }
    }
  }
  return skin;
}

double mean_edge(const fill::FillInput& skin)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < skin.triangle_vertices.size(); t += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      sum += norm(corner(skin, t + c) - corner(skin, t + (c + 1) % 3));
  }
  return sum / static_cast<double>(skin.triangle_vertices.size());
}

double enclosed_volume(const fill::FillInput& skin)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < skin.triangle_vertices.size(); t += 3) {
    sum += dot(corner(skin, t), cross(corner(skin, t + 1), corner(skin, t + 2))) / 6.0;
  }
  return sum;
}

}  // namespace tessera::testing
