// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/column_folds.hpp"

#include <array>
#include <set>
#include <span>

#include "tessera/mesh/prism.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/untangle/fold_test.hpp"

namespace tessera::subdomain {
namespace {

using Triangle = std::array<Vec3, 3>;

Triangle corners_of(const mesh::Skin& skin, LocalIndex triangle)
{
  Triangle corners{};
  for (std::size_t c = 0; c < 3; ++c) {
    corners[c] = point_at(std::span(skin.vertex_xyz), skin.triangle_vertices[3 * at(triangle) + c]);
  }
  return corners;
}

Triangle between(const Triangle& tets, const Triangle& wall, double part)
{
  Triangle corners = wall;
  for (std::size_t c = 0; c < 3; ++c) {
    if (part != 1.0) corners[c] = tets[c] + part * (wall[c] - tets[c]);
  }
  return corners;
}

bool is_bad_stack(const Triangle& tets, const Triangle& wall, std::span<const double> ends)
{
  Triangle low = tets;
  for (const double end : ends) {
    const Triangle high = between(tets, wall, end);
    if (!mesh::is_positive_prism(low, high)) return true;
    low = high;
  }
  return false;
}

// The points of the geometry that decide where a coarse triangle and its sides are.
std::vector<mesh::LatticePointKey> points_of(const mesh::Complex& complex,
                                             const mesh::RefinedLattice& lattice, LocalIndex t)
{
  std::vector<mesh::LatticePointKey> keys;
  for (std::size_t side = 0; side < 3; ++side) {
    const LocalIndex e = complex.triangle_edges[3 * at(t) + side];
    const LocalIndex n = lattice.edge_intervals(e);
    for (LocalIndex k = 1; k < n; ++k) {
      keys.push_back(mesh::LatticePointKey::on_edge(complex.edge_skeleton[at(e)], n, k));
    }
  }
  const LocalIndex n = lattice.triangle_intervals(t);
  for (LocalIndex j = 1; j < n; ++j) {
    for (LocalIndex i = 1; i + j < n; ++i) {
      keys.push_back(
          mesh::LatticePointKey::on_triangle(complex.triangle_skeleton[at(t)], n, {i, j}));
    }
  }
  return keys;
}

}  // namespace

std::vector<mesh::PointLimit> find_column_folds(const mesh::Complex& complex,
                                                const mesh::RefinedLattice& lattice,
                                                const refine::RefineContext& refine,
                                                LocalIndex subdomain)
{
  if (lattice.walls == nullptr) return {};
  const mesh::WallLayers& layers = refine.coarse.layers;
  const mesh::Skin tets = refine::extract_skin(complex, lattice, refine.skeleton, subdomain);
  const mesh::Skin walls =
      refine::extract_skin(complex, *lattice.walls, refine.skeleton, subdomain);
  std::set<LocalIndex> bad;
  for (LocalIndex t = 0; t < tets.num_triangles(); ++t) {
    const LocalIndex parent = tets.triangle_parent[at(t)];
    if (!layers.is_wall(refine.skeleton.triangle_patch[at(parent)])) continue;
    if (is_bad_stack(corners_of(tets, t), corners_of(walls, t), layers.ends)) bad.insert(parent);
  }
  std::vector<mesh::PointLimit> smaller;
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    if (!bad.contains(complex.triangle_skeleton[at(t)])) continue;
    for (const mesh::LatticePointKey& key : points_of(complex, lattice, t)) {
      const double factor = refine.limiter.factor(key);
      if (factor > 0.0) smaller.push_back({key, untangle::next_factor(factor)});
    }
  }
  return smaller;
}

}  // namespace tessera::subdomain
