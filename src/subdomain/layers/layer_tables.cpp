// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/layer_tables.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tessera/layers/prism_tets.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/mesh/triangle_grading.hpp"

namespace tessera::subdomain {
namespace {

using mesh::HostKind;
using mesh::lattice::TrianglePoint;

// Prisms whose columns stand at some corners only are cut into fewer tets.
LocalIndex num_tets_of_prism(const std::array<bool, 3>& has_column)
{
  layers::Prism prism{0, 1, 2, 0, 1, 2};
  for (std::size_t c = 0; c < 3; ++c) {
    if (has_column[c]) prism[3 + c] += 3;
  }
  std::vector<LocalIndex> tets;
  return layers::append_prism_tets(prism, true, tets);
}

}  // namespace

bool has_columns(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                 const mesh::HostLayout& hosts, mesh::HostEntity host)
{
  const auto has_any = [&](const LocalIndex* vertices, std::size_t num_vertices) {
    return std::any_of(vertices, vertices + num_vertices, [&](LocalIndex v) {
      const LocalIndex of_mesh = skeleton.vertex_coarse[at(v)];
      return coarse.layers.wall(of_mesh) != coarse.position(of_mesh);
    });
  };
  const LocalIndex row = hosts.row_of(host);
  switch (hosts.kind_of(host)) {
    case HostKind::vertex:
      return has_any(&row, 1);
    case HostKind::edge:
      return skeleton.is_on_wall(row) && has_any(&skeleton.edge_vertices[2 * at(row)], 2);
    case HostKind::triangle:
      return coarse.layers.is_wall(skeleton.triangle_patch[at(row)])
             && has_any(&skeleton.triangle_vertices[3 * at(row)], 3);
    default:
      return false;
  }
}

LayerTables::LayerTables(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                         const mesh::LatticeLevels& levels)
    : coarse_(&coarse), skeleton_(&skeleton), hosts_(skeleton)
{
  count_columns(levels);
  find_owners();
  count_cells(levels);
}

void LayerTables::count_columns(const mesh::LatticeLevels& levels)
{
  const auto add = [&](mesh::HostEntity host, LocalIndex intervals) {
    const GlobalIndex num_points = subdomain::has_columns(*coarse_, *skeleton_, hosts_, host)
                                       ? mesh::num_points_of_host(hosts_.kind_of(host), intervals)
                                       : 0;
    first_column_.push_back(first_column_.back() + num_points);
  };
  for (LocalIndex v = 0; v < skeleton_->num_vertices(); ++v) add(hosts_.vertex(v), 1);
  for (LocalIndex e = 0; e < skeleton_->num_edges(); ++e) {
    add(hosts_.edge(e), levels.edge_intervals(e));
  }
  for (LocalIndex t = 0; t < skeleton_->num_triangles(); ++t) {
    add(hosts_.triangle(t), levels.triangle_intervals(t));
  }
}

void LayerTables::find_owners()
{
  column_owner_.assign(at(hosts_.num_on_skeleton()), kNoIndex);
  const auto own = [&](mesh::HostEntity host, LocalIndex subdomain) {
    LocalIndex& owner = column_owner_[at(host)];
    owner = owner == kNoIndex ? subdomain : std::min(owner, subdomain);
  };
  has_inner_side_.assign(at(skeleton_->num_edges()), 0);
  for (LocalIndex t = 0; t < skeleton_->num_triangles(); ++t) {
    if (!is_wall_triangle(t)) {
      mark_inner_sides(t);
      continue;
    }
    const LocalIndex subdomain = skeleton_->triangle_owner(t);
    own(hosts_.triangle(t), subdomain);
    for (std::size_t c = 0; c < 3; ++c) {
      own(hosts_.vertex(skeleton_->triangle_vertices[3 * at(t) + c]), subdomain);
      own(hosts_.edge(skeleton_->triangle_edges[3 * at(t) + c]), subdomain);
    }
  }
}

void LayerTables::mark_inner_sides(LocalIndex triangle)
{
  if (!skeleton_->is_inside(triangle)) return;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t edge = at(skeleton_->triangle_edges[3 * at(triangle) + c]);
    const bool is_its = skeleton_->edge_side_patch[edge] == skeleton_->triangle_patch[at(triangle)];
    if (is_its && skeleton_->edge_side_patch[edge] != kNoIndex) has_inner_side_[edge] = 1;
  }
}

void LayerTables::count_cells(const mesh::LatticeLevels& levels)
{
  counts_.resize(at(skeleton_->num_subdomains()));
  for (LocalIndex t = 0; t < skeleton_->num_triangles(); ++t) {
    if (!is_wall_triangle(t)) continue;
    counts_[at(skeleton_->triangle_owner(t))].tets += num_tets_on(t, levels);
  }
  for (LocalIndex e = 0; e < skeleton_->num_edges(); ++e) {
    if (!skeleton_->is_on_wall(e) || skeleton_->edge_side_patch[at(e)] == kNoIndex) continue;
    counts_[at(owner(hosts_.edge(e)))].side_triangles +=
        num_side_triangles_on(e, levels.edge_intervals(e));
  }
}

GlobalIndex LayerTables::num_tets_on(LocalIndex triangle, const mesh::LatticeLevels& levels) const
{
  const mesh::TriangleGrading grading =
      mesh::triangle_grading(*skeleton_, *coarse_, levels, triangle);
  const LocalIndex n = grading.finest_intervals();
  const LocalIndex* v = &skeleton_->triangle_vertices[3 * at(triangle)];
  std::array<bool, 3> on_corner{};
  for (std::size_t c = 0; c < 3; ++c) on_corner[c] = has_columns(hosts_.vertex(v[c]));
  const auto num_with = std::ranges::count(on_corner, true);
  if (num_with == 0) return 0;
  if (num_with == 3) {
    return 3 * num_layers() * mesh::num_small_triangles(*skeleton_, levels, triangle);
  }
  // A point has a column unless it lies on no corner that has one.
  const auto has_column = [&](const TrianglePoint& p) {
    return (on_corner[0] && p.i + p.j < n) || (on_corner[1] && p.i > 0)
           || (on_corner[2] && p.j > 0);
  };
  GlobalIndex num_tets = 0;
  mesh::for_each_graded_triangle(
      grading, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
        num_tets += num_tets_of_prism({has_column(a), has_column(b), has_column(c)});
      });
  return num_tets * num_layers();
}

GlobalIndex LayerTables::num_side_triangles_on(LocalIndex edge, LocalIndex intervals) const
{
  const LocalIndex* v = &skeleton_->edge_vertices[2 * at(edge)];
  const int num_with = static_cast<int>(has_columns(hosts_.vertex(v[0])))
                       + static_cast<int>(has_columns(hosts_.vertex(v[1])));
  if (num_with == 0) return 0;
  return num_layers() * (2 * GlobalIndex{intervals} - (2 - num_with));
}

bool LayerTables::is_end(LocalIndex edge, mesh::HostEntity vertex) const
{
  const LocalIndex* v = &skeleton_->edge_vertices[2 * at(edge)];
  return hosts_.vertex(v[0]) == vertex || hosts_.vertex(v[1]) == vertex;
}

LocalIndex LayerTables::common_edge(const mesh::HostPoint& a, const mesh::HostPoint& b) const
{
  const HostKind kind_a = hosts_.kind_of(a.host);
  const HostKind kind_b = hosts_.kind_of(b.host);
  if (kind_a == HostKind::edge) {
    const LocalIndex edge = hosts_.row_of(a.host);
    const bool is_common = b.host == a.host || (kind_b == HostKind::vertex && is_end(edge, b.host));
    return is_common ? edge : kNoIndex;
  }
  if (kind_a != HostKind::vertex) return kNoIndex;
  if (kind_b == HostKind::edge) return common_edge(b, a);
  if (kind_b != HostKind::vertex) return kNoIndex;
  return mesh::find_edge_row(skeleton_->edge_vertices, hosts_.row_of(a.host),
                             hosts_.row_of(b.host));
}

std::optional<LayerSide> LayerTables::side(const mesh::HostPoint& a, const mesh::HostPoint& b,
                                           LocalIndex subdomain) const
{
  const LocalIndex edge = common_edge(a, b);
  if (edge == kNoIndex || owner(hosts_.edge(edge)) != subdomain) return std::nullopt;
  const LocalIndex patch = skeleton_->edge_side_patch[at(edge)];
  if (patch == kNoIndex) return std::nullopt;
  return LayerSide{patch, has_inner_side_[at(edge)] == 0};
}

std::optional<LayerTables> layer_tables(const mesh::CoarseMesh& coarse,
                                        const mesh::Skeleton& skeleton,
                                        const mesh::LatticeLevels& levels)
{
  if (coarse.layers.are_none()) return std::nullopt;
  return LayerTables(coarse, skeleton, levels);
}

}  // namespace tessera::subdomain
