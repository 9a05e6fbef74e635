// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layer_columns.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/layer_tables.hpp"

namespace tessera::subdomain {
namespace {

// Points of the columns at the rim of a wall lie on the patch without layers beside it.
class ColumnMaker {
 public:
  ColumnMaker(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
              const mesh::Skin& skin, const mesh::Skin& walls, const refine::RefineContext& refine)
      : skin_(skin), walls_(walls), refine_(refine), hosts_(refine.skeleton)
  {
    for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
      intervals_.emplace(complex.edge_skeleton[at(e)], lattice.edge_intervals(e));
    }
  }

  mesh::Columns run()
  {
    std::vector<LocalIndex> order(at(skin_.num_vertices()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](LocalIndex v) { return name(v); });
    for (const LocalIndex v : order) {
      if (!has_columns(refine_.coarse, refine_.skeleton, hosts_, name(v).host)) continue;
      columns_.vertices.push_back(name(v));
      add_points(v);
    }
    return std::move(columns_);
  }

 private:
  [[nodiscard]] mesh::HostPoint name(LocalIndex v) const
  {
    return {skin_.vertex_host[at(v)], skin_.vertex_index[at(v)]};
  }

  void add_points(LocalIndex v)
  {
    const Vec3 wall = point_at(std::span(walls_.vertex_xyz), v);
    const Vec3 column = point_at(std::span(skin_.vertex_xyz), v) - wall;
    for (const double end : refine_.coarse.layers.ends) {
      const Vec3 point = end == 1.0 ? wall : on_side_patch(v, wall + (1.0 - end) * column);
      columns_.point_xyz.insert(columns_.point_xyz.end(), point.begin(), point.end());
    }
  }

  [[nodiscard]] Vec3 on_side_patch(LocalIndex v, const Vec3& point) const
  {
    const mesh::HostPoint at_name = name(v);
    const mesh::HostKind kind = hosts_.kind_of(at_name.host);
    if (kind == mesh::HostKind::vertex) {
      return refine::side_point_of_vertex(refine_, hosts_.row_of(at_name.host), point);
    }
    if (kind != mesh::HostKind::edge) return point;
    const LocalIndex edge = hosts_.row_of(at_name.host);
    return refine::side_point_of_edge(refine_, edge, intervals_.at(edge), at_name.index + 1, point);
  }

  const mesh::Skin& skin_;
  const mesh::Skin& walls_;
  const refine::RefineContext& refine_;
  mesh::HostLayout hosts_;
  std::unordered_map<LocalIndex, LocalIndex> intervals_{};  // Of edges of the skeleton.
  mesh::Columns columns_{};
};

}  // namespace

mesh::Columns make_columns(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                           const mesh::Skin& skin, const refine::RefineContext& refine,
                           LocalIndex subdomain)
{
  if (lattice.walls == nullptr) return {};
  const mesh::Skin walls =
      refine::extract_skin(complex, *lattice.walls, refine.skeleton, subdomain);
  return ColumnMaker(complex, lattice, skin, walls, refine).run();
}

}  // namespace tessera::subdomain
