// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/kept_tets.hpp"

#include <algorithm>
#include <map>

#include "tessera/base/sort_unique.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::coarse {
namespace {

// Mean ratio of a flat tet. On 27 files of the corpus 0.01 and 0.05 gave the same figures; with 0.1
// smallest angles were a little larger, and more files had smaller ones than before.
constexpr double kFlat = 0.02;

using Edge = std::array<LocalIndex, 2>;

struct EdgeUse {
  LocalIndex num_triangles = 0;
  bool is_inside = false;  // Of the domain.
};

}  // namespace

KeptTets::KeptTets(const surface::DomainSkin& skin, std::span<const double> xyz,
                   std::span<const double> lattice_side)
    : skin_(skin),
      xyz_(xyz),
      inner_patch_(*std::ranges::max_element(skin.triangle_patch) + 1),
      tets_(delaunay::tetrahedralize(xyz, lattice_side)),
      cut_(delaunay::cut_by_surface(xyz, tets_, skin.triangle_vertices,
                                    static_cast<LocalIndex>(skin.vertex.size())))
{
}

void KeptTets::take_out_flat()
{
  std::vector<LocalIndex> flat;
  for (LocalIndex tet = 0; tet < tets_.num_tets(); ++tet) {
    if (is_kept(tet) && is_flat(tet)) flat.push_back(tet);
  }
  for (const LocalIndex tet : flat) {
    take_out(tet);
    for (const LocalIndex across : std::span(tets_.tet_neighbours).subspan(4 * at(tet), 4)) {
      if (across != kNoIndex && is_kept(across >> 2)) take_out(across >> 2);
    }
  }
}

bool KeptTets::is_flat(LocalIndex tet) const
{
  return quality::mean_ratio(corners_at<4>(xyz_, vertices_of(tet), 0)) < kFlat;
}

void KeptTets::take_out_around(std::span<const LocalIndex> vertices)
{
  for (const LocalIndex v : vertices) {
    for (const LocalIndex tet : stars()[v]) {
      if (is_kept(tet)) take_out(tet);
    }
  }
}

const IndexLists& KeptTets::stars()
{
  if (stars_.num_lists() == 0) {
    stars_ = rows_by_key(tets_.tet_vertices, static_cast<LocalIndex>(xyz_.size() / 3), 4);
  }
  return stars_;
}

std::vector<surface::DomainSkin> KeptTets::holes()
{
  std::vector<HoleTriangle> triangles = hole_triangles();
  while (open_pinches(triangles)) triangles = hole_triangles();
  sort_by_hole(triangles);
  std::vector<surface::DomainSkin> holes;
  for (auto first = triangles.begin(); first != triangles.end();) {
    const auto last = std::ranges::find_if(first, triangles.end(), [&](const HoleTriangle& other) {
      return other.hole != first->hole;
    });
    holes.push_back(hole_of({first, last}));
    first = last;
  }
  return holes;
}

std::vector<LocalIndex> KeptTets::tet_vertices() const
{
  std::vector<LocalIndex> kept;
  for (LocalIndex tet = 0; tet < tets_.num_tets(); ++tet) {
    if (!is_kept(tet)) continue;
    const auto v = vertices_of(tet);
    kept.insert(kept.end(), v.begin(), v.end());
  }
  return kept;
}

std::vector<KeptTets::HoleTriangle> KeptTets::hole_triangles() const
{
  std::vector<HoleTriangle> triangles;
  std::vector<char> is_of_skin(tets_.tet_vertices.size(), 0);
  for (LocalIndex t = 0; at(t) < cut_.triangle_corner.size(); ++t) {
    const LocalIndex corner = cut_.triangle_corner[at(t)];
    if (corner != kNoIndex && is_kept(corner >> 2)) {
      is_of_skin[at(corner)] = 1;
      continue;
    }
    const LocalIndex* v = &skin_.triangle_vertices[3 * at(t)];
    triangles.push_back({0, {v[0], v[1], v[2]}, skin_.triangle_patch[at(t)]});
  }
  for (LocalIndex corner = 0; at(corner) < is_of_skin.size(); ++corner) {
    const LocalIndex across = tets_.tet_neighbours[at(corner)];
    if (!is_kept(corner >> 2) || is_of_skin[at(corner)] != 0) continue;
    if (across != kNoIndex && is_kept(across >> 2)) continue;
    const auto& [a, b, c] = mesh::kTetFaceCorners[at(corner & 3)];
    const auto v = vertices_of(corner >> 2);
    triangles.push_back({0, {v[a], v[c], v[b]}, inner_patch_});
  }
  return triangles;
}

// Takes out kept tets at edges where a hole touches itself or another one; whether there were some.
// The skin may do so by itself.
bool KeptTets::open_pinches(std::span<const HoleTriangle> triangles)
{
  std::map<Edge, EdgeUse> uses;
  for (const HoleTriangle& triangle : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      EdgeUse& use = uses[mesh::sorted_edge(triangle.vertices[c], triangle.vertices[(c + 1) % 3])];
      ++use.num_triangles;
      use.is_inside = use.is_inside || triangle.patch == inner_patch_;
    }
  }
  bool was_open = false;
  for (const auto& [edge, use] : uses) {
    if (use.num_triangles == 2 || !use.is_inside) continue;
    for (const LocalIndex tet : stars()[edge[0]]) {
      if (!is_kept(tet) || std::ranges::count(vertices_of(tet), edge[1]) == 0) continue;
      take_out(tet);
      was_open = true;
    }
  }
  return was_open;
}

// One hole after the other. Space whose tets meet in a vertex is one hole, so that a part of the
// domain which lies in a hole bounds it too.
void KeptTets::sort_by_hole(std::vector<HoleTriangle>& triangles) const
{
  UnionFind sets(static_cast<LocalIndex>(xyz_.size() / 3));
  for (LocalIndex tet = 0; tet < tets_.num_tets(); ++tet) {
    if (cut_.tet_side[at(tet)] != delaunay::Side::crossed) continue;
    for (const LocalIndex v : vertices_of(tet)) sets.join(vertices_of(tet)[0], v);
  }
  for (const HoleTriangle& triangle : triangles) {
    for (const LocalIndex v : triangle.vertices) sets.join(triangle.vertices[0], v);
  }
  for (HoleTriangle& triangle : triangles) triangle.hole = sets.find(triangle.vertices[0]);
  std::ranges::stable_sort(triangles, {}, &HoleTriangle::hole);
}

surface::DomainSkin KeptTets::hole_of(std::span<const HoleTriangle> triangles) const
{
  surface::DomainSkin hole{
      .max_size = skin_.max_size, .model_box = skin_.model_box, .is_hole = true};
  for (const HoleTriangle& triangle : triangles) {
    hole.vertex.insert(hole.vertex.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  sort_unique(hole.vertex);
  for (const LocalIndex v : hole.vertex) {
    const Vec3 point = point_at(xyz_, v);
    hole.vertex_xyz.insert(hole.vertex_xyz.end(), point.begin(), point.end());
  }
  for (const HoleTriangle& triangle : triangles) {
    hole.triangle_patch.push_back(triangle.patch);
    for (const LocalIndex v : triangle.vertices) {
      hole.triangle_vertices.push_back(
          static_cast<LocalIndex>(std::ranges::lower_bound(hole.vertex, v) - hole.vertex.begin()));
    }
  }
  return hole;
}

}  // namespace tessera::coarse
