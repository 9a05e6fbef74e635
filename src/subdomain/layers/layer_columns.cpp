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

#include "subdomain/layers/column_ends.hpp"

namespace tessera::subdomain {
namespace {

// The edges of a complex on walls, of those that are images elsewhere their origins. Ascending.
std::vector<LocalIndex> origins_of_wall_edges(const mesh::Complex& complex,
                                              const mesh::Skeleton& skeleton)
{
  std::vector<LocalIndex> origins;
  for (const LocalIndex edge : complex.edge_skeleton) {
    if (edge == kNoIndex) continue;
    const LocalIndex origin = skeleton.orbits.edge_columns.origin_of(edge);
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
      if (complex.edge_skeleton[at(e)] == kNoIndex) continue;
      intervals_.emplace(hosts_.edge(complex.edge_skeleton[at(e)]), lattice.edge_intervals(e));
    }
    for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
      if (complex.triangle_skeleton[at(t)] == kNoIndex) continue;
      intervals_.emplace(hosts_.triangle(complex.triangle_skeleton[at(t)]),
                         lattice.triangle_intervals(t));
    }
  }

  mesh::Columns run()
  {
    std::vector<LocalIndex> order(at(skin_.num_vertices()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](LocalIndex v) { return name(v); });
    for (auto first = order.begin(); first != order.end();) {
      const mesh::HostEntity host = name(*first).host;
      const auto last =
          std::find_if(first, order.end(), [&](LocalIndex v) { return name(v).host != host; });
      if (num_layers_on(refine_.coarse, refine_.skeleton, hosts_, host) > 0) {
        add_host(host, {first, last});
      }
      first = last;
    }
    return std::move(columns_);
  }

 private:
  void add_host(mesh::HostEntity host, std::span<const LocalIndex> vertices)
  {
    const mesh::HostKind kind = hosts_.kind_of(host);
    const LocalIndex n = kind == mesh::HostKind::vertex ? 1 : intervals_.at(host);
    ColumnEnds ends(refine_.coarse, refine_.skeleton, kind, origin_of(host).row, n);
    for (const LocalIndex v : vertices) {
      columns_.vertices.push_back(name(v));
      add_points(v, ends.at_point(name(v).index));
    }
  }

  // Its ends, and the row of the vertex or edge that it stands on; where its image is.
  struct Column {
    Vec3 wall{};
    Vec3 tets{};
    LocalIndex row = kNoIndex;
    LocalIndex image = 0;
  };

  // What a host is an image of, and by which transform; itself by none.
  struct Origin {
    LocalIndex row = kNoIndex;
    LocalIndex image = 0;
  };

  [[nodiscard]] Origin origin_of(mesh::HostEntity host) const
  {
    const mesh::Orbits& orbits = refine_.skeleton.orbits;
    const LocalIndex row = hosts_.row_of(host);
    const auto in = [&](const auto& rows) -> Origin {
      return {rows.origin_of(row), rows.image_of(row)};
    };
    switch (hosts_.kind_of(host)) {
      case mesh::HostKind::vertex:
        return in(orbits.vertex_columns);
      case mesh::HostKind::edge:
        return in(orbits.edge_columns);
      default:
        return {row};
    }
  }

  [[nodiscard]] mesh::HostPoint name(LocalIndex v) const
  {
    return {skin_.vertex_host[at(v)], skin_.vertex_index[at(v)]};
  }

  void add_points(LocalIndex v, std::span<const LayerEnd> ends)
  {
    const Vec3 wall = point_at(std::span(walls_.vertex_xyz), v);
    const Column column = column_of(v, wall);
    const auto point_at_end = [&](const LayerEnd& end) {
      if (end.part == 0.0) return point_at(std::span(skin_.vertex_xyz), v);
      if (end.part == 1.0) return wall;
      const Vec3 straight =
          column.wall + (1.0 - end.part) * (column.tets - column.wall) + end.aside;
      return refine_.skeleton.orbits.image(column.image, on_side_patch(name(v), column, straight));
    };
    for (const LayerEnd& end : ends) {
      const Vec3 point = point_at_end(end);
      columns_.point_xyz.insert(columns_.point_xyz.end(), point.begin(), point.end());
    }
  }

  [[nodiscard]] Column column_of(LocalIndex v, const Vec3& wall) const
  {
    const mesh::HostPoint at_name = name(v);
    const auto [row, image] = origin_of(at_name.host);
    if (image != 0 && hosts_.kind_of(at_name.host) == mesh::HostKind::vertex) {
      const LocalIndex vertex = refine_.skeleton.vertex_coarse[at(row)];
      return {refine_.coarse.layers.wall(vertex), refine_.coarse.position(vertex), row, image};
    }
    if (image != 0) {
      const auto found = std::ranges::lower_bound(origins_.edge_skeleton, row);
      const auto e = static_cast<LocalIndex>(found - origins_.edge_skeleton.begin());
      const LocalIndex k = at_name.index + 1;
      return {origin_points_.walls->edge_point(e, k), origin_points_.edge_point(e, k), row, image};
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
    const LocalIndex n = intervals_.at(at_name.host);
    return refine::side_point_of_edge(refine_, column.row, n, at_name.index + 1, point);
  }

  const mesh::Skin& skin_;
  const mesh::Skin& walls_;
  const refine::RefineContext& refine_;
  mesh::HostLayout hosts_;
  mesh::Complex origins_;  // Edges on walls whose images the complex has.
  mesh::RefinedLattice origin_points_{};
  std::unordered_map<mesh::HostEntity, LocalIndex> intervals_{};  // Of edges and triangles.
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
