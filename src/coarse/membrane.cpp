// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/membrane.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/coarse/surface_overlap.hpp"
#include "tessera/mesh/half_edges.hpp"

namespace tessera::coarse {
namespace {

using Edge = std::array<LocalIndex, 2>;

constexpr int kMostPasses = 4;

Edge sorted(LocalIndex a, LocalIndex b) { return {std::min(a, b), std::max(a, b)}; }

// Parts the triangles of a skin into those above and those below a plane.
class Parting {
 public:
  Parting(const DomainSkin& skin, const cut::Plane& plane, const IndexLists& edges)
      : skin_(skin),
        opposite_(mesh::opposite_half_edges(edges)),
        is_above_(skin.triangle_patch.size())
  {
    for (std::size_t t = 0; t < is_above_.size(); ++t) {
      double height = 0.0;
      for (std::size_t c = 0; c < 3; ++c) height += plane.height(position(3 * t + c));
      is_above_[t] = height > 0.0 ? 1 : 0;
    }
  }

  // A triangle with two neighbours on the other side is a tooth of the border.
  void smooth()
  {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      bool is_smooth = true;
      for (std::size_t t = 0; t < is_above_.size(); ++t) {
        if (num_neighbours_across(t) < 2) continue;
        is_above_[t] = is_above_[t] == 0 ? 1 : 0;
        is_smooth = false;
      }
      if (is_smooth) return;
    }
  }

  // Paths that touch at a vertex are one path if all around it is on one side.
  void part_paths_that_touch()
  {
    const std::set<LocalIndex> touching = vertices_met_twice();
    for (std::size_t corner = 0; corner < skin_.triangle_vertices.size(); ++corner) {
      if (touching.contains(skin_.triangle_vertices[corner])) is_above_[corner / 3] = 0;
    }
  }

  [[nodiscard]] bool is_simple() const { return vertices_met_twice().empty(); }

  // Seen from above, what is below the border is to the right of the edges of its triangles.
  [[nodiscard]] std::vector<Edge> border() const
  {
    std::vector<Edge> edges;
    for (std::size_t h = 0; h < opposite_.size(); ++h) {
      if (is_above_[h / 3] != 0 || !is_border(h)) continue;
      const auto next = at(mesh::next_in_triangle(static_cast<LocalIndex>(h)));
      edges.push_back({skin_.triangle_vertices[next], skin_.triangle_vertices[h]});
    }
    return edges;
  }

  [[nodiscard]] std::vector<char> take_sides() { return std::move(is_above_); }

 private:
  [[nodiscard]] Vec3 position(std::size_t corner) const
  {
    return point_at(std::span(skin_.vertex_xyz), skin_.triangle_vertices[corner]);
  }

  [[nodiscard]] bool is_border(std::size_t half_edge) const
  {
    return is_above_[half_edge / 3] != is_above_[at(opposite_[half_edge]) / 3];
  }

  [[nodiscard]] int num_neighbours_across(std::size_t t) const
  {
    int num = 0;
    for (std::size_t c = 0; c < 3; ++c) num += is_border(3 * t + c) ? 1 : 0;
    return num;
  }

  [[nodiscard]] std::set<LocalIndex> vertices_met_twice() const
  {
    std::set<LocalIndex> met;
    std::set<LocalIndex> twice;
    for (const Edge& edge : border()) {
      if (!met.insert(edge[0]).second) twice.insert(edge[0]);
    }
    return twice;
  }

  const DomainSkin& skin_;
  std::vector<LocalIndex> opposite_;
  std::vector<char> is_above_;
};

bool is_closed(const IndexLists& edges)
{
  for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
    if (edges[e].size() != 2) return false;
  }
  return edges.num_lists() > 0;
}

std::vector<Vec3> all_positions(const Membrane& membrane, const DomainSkin& skin)
{
  std::vector<Vec3> positions;
  for (const auto* xyz : {&skin.vertex_xyz, &membrane.vertex_xyz}) {
    for (std::size_t v = 0; v < xyz->size() / 3; ++v) {
      positions.push_back(point_at(std::span(*xyz), v));
    }
  }
  return positions;
}

bool looks_up(const Membrane& membrane, const std::vector<Vec3>& positions, const Vec3& up)
{
  const auto& v = membrane.triangle_vertices;
  for (std::size_t c = 0; c < v.size(); c += 3) {
    const Vec3 a = positions[at(v[c])];
    const Vec3 normal = cross(positions[at(v[c + 1])] - a, positions[at(v[c + 2])] - a);
    if (!(dot(normal, up) > 0.0)) return false;
  }
  return !v.empty();
}

// Every edge inside has its opposite once and is none of the skin; those without one are the
// border.
bool ends_at_border(const Membrane& membrane, const DomainSkin& skin, const MembraneBorder& border)
{
  std::set<Edge> of_skin;
  for (std::size_t h = 0; h < skin.triangle_vertices.size(); ++h) {
    const auto next = at(mesh::next_in_triangle(static_cast<LocalIndex>(h)));
    of_skin.insert(sorted(skin.triangle_vertices[h], skin.triangle_vertices[next]));
  }
  std::set<Edge> open;
  const auto& v = membrane.triangle_vertices;
  for (std::size_t h = 0; h < v.size(); ++h) {
    const auto next = at(mesh::next_in_triangle(static_cast<LocalIndex>(h)));
    if (open.erase({v[next], v[h]}) == 1) {
      if (of_skin.contains(sorted(v[h], v[next]))) return false;
    } else if (!open.insert({v[h], v[next]}).second) {
      return false;
    }
  }
  return open == std::set<Edge>(border.edges.begin(), border.edges.end());
}

}  // namespace

std::optional<MembraneBorder> membrane_border(const DomainSkin& skin, const cut::Plane& plane)
{
  const IndexLists edges = mesh::half_edges_of_edges(skin.triangle_vertices);
  if (!is_closed(edges)) return std::nullopt;
  Parting parting(skin, plane, edges);
  parting.smooth();
  for (int pass = 0; pass < kMostPasses && !parting.is_simple(); ++pass) {
    parting.part_paths_that_touch();
    parting.smooth();
  }
  MembraneBorder border{.plane = plane, .edges = parting.border()};
  if (border.edges.empty() || !parting.is_simple()) return std::nullopt;
  border.is_above = parting.take_sides();
  return border;
}

bool is_sound(const Membrane& membrane, const DomainSkin& skin, const MembraneBorder& border)
{
  PatchSurface together;
  together.vertex_xyz = all_positions(membrane, skin);
  if (!looks_up(membrane, together.vertex_xyz, border.plane.normal)) return false;
  if (!ends_at_border(membrane, skin, border)) return false;
  for (const auto* v : {&skin.triangle_vertices, &membrane.triangle_vertices}) {
    for (std::size_t c = 0; c < v->size(); c += 3) {
      together.triangles.push_back({(*v)[c], (*v)[c + 1], (*v)[c + 2]});
    }
  }
  const std::size_t num_skin = skin.triangle_patch.size();
  return std::ranges::none_of(find_overlaps(together), [&](const Overlap& overlap) {
    return std::max(overlap.first, overlap.second) >= num_skin;
  });
}

}  // namespace tessera::coarse
