// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layers/layer_columns.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

#include "tessera/base/sort_unique.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/layer_tables.hpp"

namespace tessera::subdomain {
namespace {

// The edges of a complex on walls, of those that are images elsewhere their origins. Ascending.
std::vector<LocalIndex> origins_of_wall_edges(const mesh::Complex& complex,
                                              const mesh::Skeleton& skeleton)
{
  std::vector<LocalIndex> origins;
  for (const LocalIndex edge : complex.edge_skeleton) {
    if (edge == kNoIndex) continue;
    const LocalIndex origin = skeleton.orbits.edges.origin_of(edge);
    if (origin != edge && skeleton.is_on_wall(edge)) origins.push_back(origin);
  }
  sort_unique(origins);
  return origins;
}

// Points of the columns at the rim of a wall lie on the patch without layers beside it. On a
// periodic side they are those of the lowest column of their orbit.
class ColumnMaker {
 public:
  ColumnMaker(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
              const mesh::Skin& skin, const mesh::Skin& walls, const refine::RefineContext& refine)
      : skin_(skin),
        walls_(walls),
        refine_(refine),
        hosts_(refine.skeleton),
        origins_(
            mesh::edge_complex(refine.skeleton, origins_of_wall_edges(complex, refine.skeleton)))
  {
    if (origins_.num_edges() > 0) origin_points_ = refine::refine_lattice(origins_, refine);
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
  // Its ends, and the row of the vertex or edge that it stands on; where its image is.
  struct Column {
    Vec3 wall{};
    Vec3 tets{};
    LocalIndex row = kNoIndex;
    LocalIndex image = 0;
  };

  [[nodiscard]] mesh::HostPoint name(LocalIndex v) const
  {
    return {skin_.vertex_host[at(v)], skin_.vertex_index[at(v)]};
  }

  void add_points(LocalIndex v)
  {
    const Vec3 wall = point_at(std::span(walls_.vertex_xyz), v);
    const Column column = column_of(v, wall);
    for (const double end : refine_.coarse.layers.ends) {
      const Vec3 straight = column.wall + (1.0 - end) * (column.tets - column.wall);
      const Vec3 point = end == 1.0 ? wall
                                    : refine_.skeleton.orbits.image(
                                        column.image, on_side_patch(name(v), column, straight));
      columns_.point_xyz.insert(columns_.point_xyz.end(), point.begin(), point.end());
    }
  }

  [[nodiscard]] Column column_of(LocalIndex v, const Vec3& wall) const
  {
    const mesh::HostPoint at_name = name(v);
    const mesh::HostKind kind = hosts_.kind_of(at_name.host);
    const LocalIndex row = hosts_.row_of(at_name.host);
    const mesh::Orbits& orbits = refine_.skeleton.orbits;
    if (kind == mesh::HostKind::vertex && orbits.vertices.image_of(row) != 0) {
      const LocalIndex origin = orbits.vertices.base_of(row);
      const LocalIndex vertex = refine_.skeleton.vertex_coarse[at(origin)];
      return {refine_.coarse.layers.wall(vertex), refine_.coarse.position(vertex), origin,
              orbits.vertices.image_of(row)};
    }
    if (kind == mesh::HostKind::edge && orbits.edges.image_of(row) != 0) {
      const LocalIndex origin = orbits.edges.base_of(row);
      const auto found = std::ranges::lower_bound(origins_.edge_skeleton, origin);
      const auto e = static_cast<LocalIndex>(found - origins_.edge_skeleton.begin());
      const LocalIndex k = at_name.index + 1;
      return {origin_points_.walls->edge_point(e, k), origin_points_.edge_point(e, k), origin,
              orbits.edges.image_of(row)};
    }
    return {.wall = wall, .tets = point_at(std::span(skin_.vertex_xyz), v), .row = row};
  }

  [[nodiscard]] Vec3 on_side_patch(const mesh::HostPoint& at_name, const Column& column,
                                   const Vec3& point) const
  {
    const mesh::HostKind kind = hosts_.kind_of(at_name.host);
    if (kind == mesh::HostKind::vertex) {
      return refine::side_point_of_vertex(refine_, column.row, point);
    }
    if (kind != mesh::HostKind::edge) return point;
    const LocalIndex n = intervals_.at(hosts_.row_of(at_name.host));
    return refine::side_point_of_edge(refine_, column.row, n, at_name.index + 1, point);
  }

  const mesh::Skin& skin_;
  const mesh::Skin& walls_;
  const refine::RefineContext& refine_;
  mesh::HostLayout hosts_;
  mesh::Complex origins_;  // Edges on walls whose images the complex has.
  mesh::RefinedLattice origin_points_{};
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
