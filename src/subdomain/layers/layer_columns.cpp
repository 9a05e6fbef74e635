// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layers/layer_columns.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/layer_tables.hpp"

#include "subdomain/layers/column_ends.hpp"

namespace tessera::subdomain {
namespace {

// Of the edges of a complex on walls that are images elsewhere, their origins, refined as finely as
// these.
class ColumnOrigins {
 public:
  ColumnOrigins(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                const refine::RefineContext& refine)
  {
    std::map<LocalIndex, int> level_of;
    const mesh::Skeleton& skeleton = refine.skeleton;
    for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
      const LocalIndex edge = complex.edge_skeleton[at(e)];
      if (edge == kNoIndex) continue;
      const LocalIndex origin = skeleton.orbits.edge_columns.origin_of(edge);
      if (origin == edge || !skeleton.is_on_wall(edge)) continue;
      int& level = level_of[origin];
      level = std::max(level, lattice.levels().edge(e));
    }
    mesh::LatticeLevels levels;
    for (const auto& [edge, level] : level_of) {
      edges_.push_back(edge);
      levels.edges.push_back(static_cast<std::int8_t>(level));
    }
    if (edges_.empty()) return;
    points_ =
        refine::refine_lattice(mesh::edge_complex(skeleton, edges_), std::move(levels), refine);
  }

  // Ends of the column over a point of one of these edges.
  struct Ends {
    Vec3 wall{};
    Vec3 tets{};
  };

  // @param[in] n Intervals of the image.
  [[nodiscard]] Ends at_point(LocalIndex edge, LocalIndex n, LocalIndex k) const
  {
    const auto e = static_cast<LocalIndex>(std::ranges::lower_bound(edges_, edge) - edges_.begin());
    const LocalIndex own = k * (points_.edge_intervals(e) / n);
    return {points_.walls->edge_point(e, own), points_.edge_point(e, own)};
  }

 private:
  std::vector<LocalIndex> edges_{};  // Of the skeleton, ascending.
  mesh::RefinedLattice points_{};
};

// Points of the columns at the rim of a wall lie on the patch without layers beside it. On a
// periodic side they are those of the lowest column of their orbit.
class ColumnMaker {
 public:
  ColumnMaker(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
              const LatticePoints& points, const refine::RefineContext& refine)
      : points_(points),
        refine_(refine),
        hosts_(refine.skeleton),
        origins_(complex, lattice, refine)
  {
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
    std::vector<LocalIndex> order(points_.names.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](LocalIndex v) { return points_.names[at(v)]; });
    for (auto first = order.begin(); first != order.end();) {
      const mesh::HostEntity host = points_.names[at(*first)].host;
      const auto last = std::find_if(
          first, order.end(), [&](LocalIndex v) { return points_.names[at(v)].host != host; });
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
      const mesh::HostPoint& name = points_.names[at(v)];
      columns_.vertices.push_back(name);
      add_points(v, ends.at_point(name.index));
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

  void add_points(LocalIndex v, std::span<const LayerEnd> ends)
  {
    const Vec3 wall = point_at(std::span(points_.walls_xyz), v);
    const Vec3 tets = point_at(std::span(points_.tets_xyz), v);
    const mesh::HostPoint& name = points_.names[at(v)];
    const Column column = column_of(name, wall, tets);
    const auto point_at_end = [&](const LayerEnd& end) {
      if (end.part == 0.0) return tets;
      if (end.part == 1.0) return wall;
      const Vec3 straight =
          column.wall + (1.0 - end.part) * (column.tets - column.wall) + end.aside;
      return refine_.skeleton.orbits.image(column.image, on_side_patch(name, column, straight));
    };
    for (const LayerEnd& end : ends) {
      const Vec3 point = point_at_end(end);
      columns_.point_xyz.insert(columns_.point_xyz.end(), point.begin(), point.end());
    }
  }

  [[nodiscard]] Column column_of(const mesh::HostPoint& name, const Vec3& wall,
                                 const Vec3& tets) const
  {
    const auto [row, image] = origin_of(name.host);
    if (image == 0) return {.wall = wall, .tets = tets, .row = row};
    if (hosts_.kind_of(name.host) == mesh::HostKind::vertex) {
      const LocalIndex vertex = refine_.skeleton.vertex_coarse[at(row)];
      return {refine_.coarse.layers.wall(vertex), refine_.coarse.position(vertex), row, image};
    }
    const auto ends = origins_.at_point(row, intervals_.at(name.host), name.index + 1);
    return {ends.wall, ends.tets, row, image};
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

  const LatticePoints& points_;
  const refine::RefineContext& refine_;
  mesh::HostLayout hosts_;
  ColumnOrigins origins_;
  std::unordered_map<mesh::HostEntity, LocalIndex> intervals_{};  // Of edges and triangles.
  mesh::Columns columns_{};
};

}  // namespace

mesh::Columns make_columns(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                           const LatticePoints& points, const refine::RefineContext& refine)
{
  return ColumnMaker(complex, lattice, points, refine).run();
}

mesh::Columns make_columns(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                           const mesh::Skin& skin, const refine::RefineContext& refine,
                           LocalIndex subdomain)
{
  if (lattice.walls == nullptr) return {};
  LatticePoints points{.tets_xyz = skin.vertex_xyz};
  for (LocalIndex v = 0; v < skin.num_vertices(); ++v) {
    points.names.push_back({skin.vertex_host[at(v)], skin.vertex_index[at(v)]});
  }
  points.walls_xyz =
      refine::extract_skin(complex, *lattice.walls, refine.skeleton, subdomain).vertex_xyz;
  return make_columns(complex, lattice, points, refine);
}

}  // namespace tessera::subdomain
