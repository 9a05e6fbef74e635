// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/patch_parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;
using Triangle = PatchSurface::Triangle;

// Vertices of curves and of several patches, and those that are fixed.
std::vector<char> vertices_of_rims(const PatchSurface& whole)
{
  std::vector<char> is_on_rim = whole.vertex_is_fixed;
  for (const Edge& edge : whole.edges) {
    for (const LocalIndex v : edge) is_on_rim[at(v)] = 1;
  }
  std::vector<LocalIndex> patch_of(whole.vertex_xyz.size(), kNoIndex);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    for (const LocalIndex v : whole.triangles[t]) {
      LocalIndex& patch = patch_of[at(v)];
      if (patch != kNoIndex && patch != whole.triangle_patch[t]) is_on_rim[at(v)] = 1;
      patch = whole.triangle_patch[t];
    }
  }
  return is_on_rim;
}

// Those of all triangles, ascending; a side of two triangles is there twice.
std::vector<Edge> sides_of(const PatchSurface& surface)
{
  std::vector<Edge> sides;
  for (const Triangle& v : surface.triangles) {
    for (std::size_t c = 0; c < 3; ++c) sides.push_back(mesh::sorted_edge(v[c], v[(c + 1) % 3]));
  }
  std::ranges::sort(sides);
  return sides;
}

// Sides of a part that lead from rim to rim, ascending.
std::vector<Edge> sides_on_rim(const PatchSurface& surface, const std::vector<LocalIndex>& rim)
{
  std::vector<Edge> sides = sides_of(surface);
  std::erase_if(sides, [&](const Edge& side) { return at(side[1]) >= rim.size(); });
  sort_unique(sides);
  return sides;
}

// Takes the patches of a surface out of it, one after the other.
class PartTaker {
 public:
  explicit PartTaker(const PatchSurface& whole)
      : whole_(whole),
        is_on_rim_(vertices_of_rims(whole)),
        number_(whole.vertex_xyz.size(), kNoIndex),
        edges_at_(whole.vertex_xyz.size())
  {
    for (std::size_t e = 0; e < whole.edges.size(); ++e)
      edges_at_[at(whole.edges[e][0])].push_back(e);
  }

  PatchPart take(const std::vector<std::size_t>& triangles)
  {
    PatchPart part;
    for (const std::size_t t : triangles) {
      for (const LocalIndex v : whole_.triangles[t]) {
        if (std::exchange(number_[at(v)], 0) != kNoIndex) continue;
        (is_on_rim_[at(v)] != 0 ? part.rim : part.inside).push_back(v);
      }
    }
    std::ranges::sort(part.rim);
    std::ranges::sort(part.inside);
    add_vertices(part.rim, part.surface);
    add_vertices(part.inside, part.surface);
    for (const std::size_t t : triangles) {
      const Triangle& v = whole_.triangles[t];
      part.surface.triangles.push_back({number_[at(v[0])], number_[at(v[1])], number_[at(v[2])]});
    }
    part.surface.triangle_patch.assign(triangles.size(), whole_.triangle_patch[triangles.front()]);
    add_edges(part);
    for (const auto* vertices : {&part.rim, &part.inside}) {
      for (const LocalIndex v : *vertices) number_[at(v)] = kNoIndex;
    }
    return part;
  }

 private:
  void add_vertices(const std::vector<LocalIndex>& vertices, PatchSurface& surface)
  {
    for (const LocalIndex v : vertices) {
      number_[at(v)] = static_cast<LocalIndex>(surface.vertex_xyz.size());
      surface.vertex_xyz.push_back(whole_.vertex_xyz[at(v)]);
      surface.vertex_is_fixed.push_back(is_on_rim_[at(v)]);
    }
  }

  void add_edges(PatchPart& part) const
  {
    const std::vector<Edge> sides = sides_on_rim(part.surface, part.rim);
    for (const LocalIndex v : part.rim) {
      for (const std::size_t e : edges_at_[at(v)]) {
        const Edge edge{number_[at(v)], number_[at(whole_.edges[e][1])]};
        if (!std::ranges::binary_search(sides, edge)) continue;
        part.surface.edges.push_back(edge);
        part.surface.edge_curve.push_back(whole_.edge_curve[e]);
      }
    }
  }

  const PatchSurface& whole_;
  std::vector<char> is_on_rim_;
  std::vector<LocalIndex> number_;                  // In the part that is being taken.
  std::vector<std::vector<std::size_t>> edges_at_;  // Rows of the edges, at their lower vertices.
};

std::vector<std::vector<std::size_t>> triangles_of_patches(const PatchSurface& whole)
{
  std::vector<std::vector<std::size_t>> triangles(at(whole.num_patches()));
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    triangles[at(whole.triangle_patch[t])].push_back(t);
  }
  return triangles;
}

// Edges of no curve, and triangles, all of whose vertices are on a rim, by their numbers in the
// whole: only these may be those of another patch. An edge has kNoIndex in the last place.
std::set<Triangle> bridges_of(const PatchSurface& surface, const std::vector<LocalIndex>& rim)
{
  const auto is_on_rim = [&](LocalIndex v) { return at(v) < rim.size(); };
  std::set<Triangle> bridges;
  for (const auto& [a, b] : sides_on_rim(surface, rim)) {
    if (std::ranges::binary_search(surface.edges, Edge{a, b})) continue;
    bridges.insert({rim[at(a)], rim[at(b)], kNoIndex});
  }
  for (const Triangle& v : surface.triangles) {
    if (!std::ranges::all_of(v, is_on_rim)) continue;
    Triangle all{rim[at(v[0])], rim[at(v[1])], rim[at(v[2])]};
    std::ranges::sort(all);
    bridges.insert(all);
  }
  return bridges;
}

// Sides that have one triangle only, ascending.
std::vector<Edge> border_of(const PatchSurface& surface)
{
  const std::vector<Edge> sides = sides_of(surface);
  std::vector<Edge> border;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_first = i == 0 || sides[i - 1] != sides[i];
    const bool is_last = i + 1 == sides.size() || sides[i + 1] != sides[i];
    if (is_first && is_last) border.push_back(sides[i]);
  }
  return border;
}

// Whether others find all of the rim that they share with the part.
bool keeps_rim(const PatchPart& part, const PatchSurface& edited)
{
  if (edited.vertex_xyz.size() < part.rim.size()) return false;
  const auto end = part.surface.vertex_xyz.begin() + static_cast<std::ptrdiff_t>(part.rim.size());
  return std::equal(part.surface.vertex_xyz.begin(), end, edited.vertex_xyz.begin())
         && edited.edges == part.surface.edges && border_of(edited) == border_of(part.surface);
}

// Whether an edge within the part is one of a curve of others.
bool crosses_curve(const PatchSurface& whole, const PatchSurface& surface,
                   const std::vector<LocalIndex>& rim)
{
  return std::ranges::any_of(bridges_of(surface, rim), [&](const Triangle& bridge) {
    return bridge[2] == kNoIndex
           && std::ranges::binary_search(whole.edges, Edge{bridge[0], bridge[1]});
  });
}

// Of each part, whether its edited surface can be taken.
std::vector<char> find_takeable(const PatchSurface& whole, const std::vector<PatchPart>& parts,
                                const std::vector<std::optional<PatchSurface>>& edited)
{
  std::vector<char> is_takeable;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_sound = edited[i] && keeps_rim(parts[i], *edited[i])
                          && !crosses_curve(whole, *edited[i], parts[i].rim);
    is_takeable.push_back(is_sound ? 1 : 0);
  }
  for (bool has_clash = true; has_clash;) {
    has_clash = false;
    std::map<Triangle, std::vector<std::size_t>> parts_of_bridge;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const PatchSurface& surface = is_takeable[i] != 0 ? *edited[i] : parts[i].surface;
      for (const Triangle& bridge : bridges_of(surface, parts[i].rim)) {
        parts_of_bridge[bridge].push_back(i);
      }
    }
    for (const auto& [bridge, holders] : parts_of_bridge) {
      if (holders.size() == 1) continue;
      for (const std::size_t i : holders)
        has_clash = std::exchange(is_takeable[i], 0) != 0 || has_clash;
    }
  }
  return is_takeable;
}

class PatchJoiner {
 public:
  PatchJoiner(const PatchSurface& whole, const std::vector<PatchPart>& parts,
              const std::vector<char>& is_edited)
      : number_(whole.vertex_xyz.size(), kNoIndex)
  {
    std::vector<char> stays(number_.size(), 0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const LocalIndex v : parts[i].rim) stays[at(v)] = 1;
      if (is_edited[i] != 0) continue;
      for (const LocalIndex v : parts[i].inside) stays[at(v)] = 1;
    }
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (stays[v] != 0) number_[v] = add_vertex(whole.vertex_xyz[v], whole.vertex_is_fixed[v]);
    }
    for (const Edge& edge : whole.edges) {
      joined_.edges.push_back({number_[at(edge[0])], number_[at(edge[1])]});
    }
    joined_.edge_curve = whole.edge_curve;
    joined_.patch_materials = whole.patch_materials;
  }

  // The first vertices of `surface` are these of the whole; others are new.
  void add(const PatchSurface& surface, const std::vector<LocalIndex>& vertices)
  {
    std::vector<LocalIndex> numbers;
    for (const LocalIndex v : vertices) numbers.push_back(number_[at(v)]);
    for (std::size_t v = numbers.size(); v < surface.vertex_xyz.size(); ++v) {
      numbers.push_back(add_vertex(surface.vertex_xyz[v], surface.vertex_is_fixed[v]));
    }
    for (const Triangle& v : surface.triangles) {
      joined_.triangles.push_back({numbers[at(v[0])], numbers[at(v[1])], numbers[at(v[2])]});
    }
    joined_.triangle_patch.insert(joined_.triangle_patch.end(), surface.triangle_patch.begin(),
                                  surface.triangle_patch.end());
  }

  PatchSurface take() && { return std::move(joined_); }

 private:
  LocalIndex add_vertex(const Vec3& xyz, char is_fixed)
  {
    joined_.vertex_xyz.push_back(xyz);
    joined_.vertex_is_fixed.push_back(is_fixed);
    return static_cast<LocalIndex>(joined_.vertex_xyz.size()) - 1;
  }

  std::vector<LocalIndex> number_;  // Of vertices of the whole that stay.
  PatchSurface joined_{};
};

}  // namespace

std::vector<PatchPart> patch_parts_of(const PatchSurface& whole)
{
  PartTaker taker(whole);
  std::vector<PatchPart> parts;
  for (const std::vector<std::size_t>& triangles : triangles_of_patches(whole)) {
    if (!triangles.empty()) parts.push_back(taker.take(triangles));
  }
  return parts;
}

JoinedPatches join_patches(const PatchSurface& whole, const std::vector<PatchPart>& parts,
                           const std::vector<std::optional<PatchSurface>>& edited)
{
  const std::vector<char> is_edited = find_takeable(whole, parts, edited);
  PatchJoiner joiner(whole, parts, is_edited);
  JoinedPatches joined;
  joined.is_edited.assign(at(whole.num_patches()), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& [surface, rim, inside] = parts[i];
    if (is_edited[i] != 0) {
      joiner.add(*edited[i], rim);
    } else {
      std::vector<LocalIndex> all = rim;
      all.insert(all.end(), inside.begin(), inside.end());
      joiner.add(surface, all);
    }
    joined.is_edited[at(surface.triangle_patch.front())] = is_edited[i];
  }
  joined.surface = std::move(joiner).take();
  return joined;
}

}  // namespace tessera::surface
