// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/layer_tables.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/layers/prism_tets.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"
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

// Hosts that stand at one place on the sides of joints.
UnionFind copies_at_joints(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                           const mesh::HostLayout& hosts)
{
  UnionFind copies(hosts.num_on_skeleton());
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const LocalIndex patch = skeleton.triangle_patch[at(t)];
    if (patch == kNoIndex || !coarse.images.is_joint(patch)) continue;
    const LocalIndex other = skeleton.orbits.triangles.base_of(t);
    copies.join(hosts.triangle(t), hosts.triangle(other));
    for (std::size_t c = 0; c < 3; ++c) {
      copies.join(hosts.vertex(skeleton.triangle_vertices[3 * at(t) + c]),
                  hosts.vertex(skeleton.triangle_vertices[3 * at(other) + c]));
      copies.join(hosts.edge(skeleton.triangle_edges[3 * at(t) + c]),
                  hosts.edge(skeleton.triangle_edges[3 * at(other) + c]));
    }
  }
  return copies;
}

}  // namespace

LocalIndex num_layers_on(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                         const mesh::HostLayout& hosts, mesh::HostEntity host)
{
  const mesh::WallLayers& layers = coarse.layers;
  const auto most_of = [&](const LocalIndex* vertices, std::size_t num_vertices) {
    LocalIndex most = 0;
    for (std::size_t i = 0; i < num_vertices; ++i) {
      const LocalIndex v = skeleton.vertex_coarse[at(vertices[i])];
      if (layers.wall(v) == coarse.position(v)) continue;
      most = std::max(most, layers.num_layers(layers.vertex_stack[at(v)]));
    }
    return most;
  };
  const LocalIndex row = hosts.row_of(host);
  switch (hosts.kind_of(host)) {
    case HostKind::vertex:
      return most_of(&row, 1);
    case HostKind::edge:
      return skeleton.is_on_wall(row) ? most_of(&skeleton.edge_vertices[2 * at(row)], 2) : 0;
    case HostKind::triangle:
      return layers.is_wall(skeleton.triangle_patch[at(row)])
                 ? most_of(&skeleton.triangle_vertices[3 * at(row)], 3)
                 : 0;
    default:
      return 0;
  }
}

LayerTables::LayerTables(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                         const mesh::LatticeLevels& levels, int splits)
    : coarse_(&coarse),
      skeleton_(&skeleton),
      parts_(mesh::lattice::intervals(splits)),
      hosts_(skeleton)
{
  find_layers();
  find_ends();
  count_columns(levels);
  find_owners();
  find_owners_of_ends();
  count_cells(levels);
}

void LayerTables::find_layers()
{
  for (mesh::HostEntity host = 0; host < hosts_.num_on_skeleton(); ++host) {
    num_layers_.push_back(num_layers_on(*coarse_, *skeleton_, hosts_, host));
  }
}

// Of the copies at a joint, one without columns is what the others end at. There is one at most:
// topology::close_joints().
void LayerTables::find_ends()
{
  UnionFind copies = copies_at_joints(*coarse_, *skeleton_, hosts_);
  end_host_.assign(at(hosts_.num_on_skeleton()), kNoIndex);
  std::vector<mesh::HostEntity> end_of(end_host_.size());
  std::iota(end_of.begin(), end_of.end(), 0);
  for (mesh::HostEntity host = 0; host < hosts_.num_on_skeleton(); ++host) {
    if (!has_columns(host)) end_of[at(copies.find(host))] = host;
  }
  for (mesh::HostEntity host = 0; host < hosts_.num_on_skeleton(); ++host) {
    end_host_[at(host)] = has_columns(host) ? end_of[at(copies.find(host))] : host;
    has_joints_ = has_joints_ || end_host_[at(host)] != host;
  }
}

std::vector<LocalIndex> LayerTables::vertices_of_ends(LocalIndex subdomain) const
{
  std::vector<LocalIndex> vertices;
  const auto add_end_of = [&](mesh::HostEntity host) {
    const mesh::HostEntity end = end_at_tets({host, 0}).host;
    if (end == host) return;
    const LocalIndex row = hosts_.row_of(end);
    const LocalIndex* v = &row;
    std::ptrdiff_t num_vertices = 1;
    if (hosts_.kind_of(end) == HostKind::edge) {
      v = &skeleton_->edge_vertices[2 * at(row)];
      num_vertices = 2;
    } else if (hosts_.kind_of(end) == HostKind::triangle) {
      v = &skeleton_->triangle_vertices[3 * at(row)];
      num_vertices = 3;
    }
    vertices.insert(vertices.end(), v, v + num_vertices);
  };
  for (const LocalIndex t : skeleton_->triangles_of(subdomain)) {
    if (!is_wall_triangle(t)) continue;
    add_end_of(hosts_.triangle(t));
    for (std::size_t c = 0; c < 3; ++c) {
      add_end_of(hosts_.vertex(skeleton_->triangle_vertices[3 * at(t) + c]));
      add_end_of(hosts_.edge(skeleton_->triangle_edges[3 * at(t) + c]));
    }
  }
  sort_unique(vertices);
  return vertices;
}

void LayerTables::count_columns(const mesh::LatticeLevels& levels)
{
  const auto add = [&](mesh::HostEntity host, GlobalIndex num_columns) {
    first_point_.push_back(first_point_.back() + num_columns * num_own_points(host));
  };
  for (LocalIndex v = 0; v < skeleton_->num_vertices(); ++v) add(hosts_.vertex(v), 1);
  for (LocalIndex e = 0; e < skeleton_->num_edges(); ++e) {
    add(hosts_.edge(e), mesh::lattice::num_inner_edge_points(levels.edge_intervals(e) * parts_));
  }
  for (LocalIndex t = 0; t < skeleton_->num_triangles(); ++t) {
    add(hosts_.triangle(t), num_columns_in(t, levels));
  }
}

LocalIndex LayerTables::num_columns_in(LocalIndex triangle, const mesh::LatticeLevels& levels) const
{
  if (!has_columns(hosts_.triangle(triangle))) return 0;
  return mesh::num_inner_split_points(
      mesh::triangle_grading(*skeleton_, *coarse_, levels, triangle), parts_);
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

void LayerTables::find_owners_of_ends()
{
  end_owner_.assign(column_owner_.size(), kNoIndex);
  for (mesh::HostEntity host = 0; host < hosts_.num_on_skeleton(); ++host) {
    if (!has_columns(host)) continue;
    LocalIndex& owner = end_owner_[at(end_host(host))];
    owner = owner == kNoIndex ? column_owner_[at(host)]
                              : std::min(owner, LocalIndex{column_owner_[at(host)]});
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
        num_side_triangles_on(e, levels.edge_intervals(e) * parts_);
  }
}

GlobalIndex LayerTables::num_tets_on(LocalIndex triangle, const mesh::LatticeLevels& levels) const
{
  const LocalIndex* v = &skeleton_->triangle_vertices[3 * at(triangle)];
  std::array<LocalIndex, 3> num_on_corner{};
  for (std::size_t c = 0; c < 3; ++c) num_on_corner[c] = num_layers(hosts_.vertex(v[c]));
  std::array<LocalIndex, 3> ends = num_on_corner;
  std::ranges::sort(ends);
  GlobalIndex num_tets = 0;
  LocalIndex from = 0;  // Layers from the wall, as far as the same corners have them.
  for (const LocalIndex to : ends) {
    if (to == from) continue;
    std::array<bool, 3> on_corner{};
    for (std::size_t c = 0; c < 3; ++c) on_corner[c] = num_on_corner[c] >= to;
    num_tets += (to - from) * num_tets_of_layer(triangle, on_corner, levels);
    from = to;
  }
  return num_tets;
}

// @param[in] on_corner Whether a corner has the layer; one has.
GlobalIndex LayerTables::num_tets_of_layer(LocalIndex triangle,
                                           const std::array<bool, 3>& on_corner,
                                           const mesh::LatticeLevels& levels) const
{
  if (std::ranges::count(on_corner, true) == 3) {
    return 3 * mesh::num_small_triangles(*skeleton_, levels, triangle) * parts_ * parts_;
  }
  const mesh::TriangleGrading grading =
      mesh::triangle_grading(*skeleton_, *coarse_, levels, triangle);
  const LocalIndex n = grading.finest_intervals() * parts_;
  // A point has it unless it lies on no corner that does.
  const auto has_column = [&](const TrianglePoint& p) {
    return (on_corner[0] && p.i + p.j < n) || (on_corner[1] && p.i > 0)
           || (on_corner[2] && p.j > 0);
  };
  GlobalIndex num_tets = 0;
  mesh::for_each_split_triangle(
      grading, parts_, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
        num_tets += num_tets_of_prism({has_column(a), has_column(b), has_column(c)});
      });
  return num_tets;
}

GlobalIndex LayerTables::num_side_triangles_on(LocalIndex edge, LocalIndex intervals) const
{
  const LocalIndex* v = &skeleton_->edge_vertices[2 * at(edge)];
  const auto [less, more] =
      std::minmax({num_layers(hosts_.vertex(v[0])), num_layers(hosts_.vertex(v[1]))});
  return more * (2 * GlobalIndex{intervals} - 1) + less;
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
                                        const mesh::LatticeLevels& levels, int splits)
{
  if (coarse.layers.are_none()) return std::nullopt;
  return LayerTables(coarse, skeleton, levels, splits);
}

std::optional<LayerTables> layer_tables(const PartitionedMesh& cut, int splits)
{
  if (cut.coarse.layers.are_none()) return std::nullopt;
  return layer_tables(cut.coarse, cut.skeleton, mesh::lattice_levels(cut.skeleton, cut.levels),
                      splits);
}

}  // namespace tessera::subdomain
