// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/column_folds.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "tessera/mesh/prism.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/untangle/fold_test.hpp"

#include "subdomain/layers/layer_columns.hpp"

namespace tessera::subdomain {
namespace {

// The layers over the triangles of a skin on walls, as they are written.
class Stacks {
 public:
  Stacks(const mesh::Skin& skin, const mesh::Columns& columns, LocalIndex most_layers)
      : skin_(skin), columns_(columns), most_layers_(most_layers)
  {
  }

  [[nodiscard]] bool is_bad(LocalIndex triangle) const
  {
    std::array<Vec3, 3> low = level(triangle, 0);
    for (LocalIndex layer = 1; layer <= most_layers_; ++layer) {
      const std::array<Vec3, 3> high = level(triangle, layer);
      if (!mesh::is_positive_prism(low, high)) return true;
      low = high;
    }
    return false;
  }

 private:
  // Corners where so many layers end; those without a column stay where they are.
  [[nodiscard]] std::array<Vec3, 3> level(LocalIndex triangle, LocalIndex num_layers) const
  {
    std::array<Vec3, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = skin_.triangle_vertices[3 * at(triangle) + c];
      const mesh::HostPoint name{skin_.vertex_host[at(v)], skin_.vertex_index[at(v)]};
      const std::size_t row = columns_.row_of(name);
      const bool has_column = row < columns_.size();
      corners[c] = num_layers > 0 && has_column
                       ? point_at(std::span(columns_.point_xyz),
                                  static_cast<LocalIndex>(row) * most_layers_ + num_layers - 1)
                       : point_at(std::span(skin_.vertex_xyz), v);
    }
    return corners;
  }

  const mesh::Skin& skin_;
  const mesh::Columns& columns_;
  LocalIndex most_layers_;
};

// The points of the geometry that decide where a coarse triangle and its sides are.
std::vector<mesh::LatticePointKey> points_of(const mesh::Complex& complex,
                                             const mesh::RefinedLattice& lattice,
                                             const mesh::Skeleton& skeleton, LocalIndex t)
{
  std::vector<mesh::LatticePointKey> keys;
  for (std::size_t c = 0; c < 3; ++c) {
    const LocalIndex v = complex.vertex_skeleton[at(complex.triangle_vertices[3 * at(t) + c])];
    const LocalIndex side_edge =
        skeleton.vertex_side_edge[at(skeleton.orbits.vertex_columns.origin_of(v))];
    if (side_edge != kNoIndex) keys.push_back(refine::key_of_vertex_limit(side_edge));
  }
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
  const mesh::Skin skin = refine::extract_skin(complex, lattice, refine.skeleton, subdomain);
  const mesh::Columns columns = make_columns(complex, lattice, skin, refine, subdomain);
  const Stacks stacks(skin, columns, layers.most_layers);
  std::set<LocalIndex> bad;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex parent = skin.triangle_parent[at(t)];
    if (!layers.is_wall(refine.skeleton.triangle_patch[at(parent)])) continue;
    if (stacks.is_bad(t)) bad.insert(parent);
  }
  std::vector<mesh::PointLimit> smaller;
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    if (!bad.contains(complex.triangle_skeleton[at(t)])) continue;
    for (const mesh::LatticePointKey& key : points_of(complex, lattice, refine.skeleton, t)) {
      const double factor = refine.limiter.factor(key);
      if (factor > 0.0) smaller.push_back({key, untangle::next_factor(factor)});
    }
  }
  return smaller;
}

}  // namespace tessera::subdomain
