// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/patch_surface.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;

struct Side {
  Edge edge{};
  LocalIndex patch = kNoIndex;
  std::array<double, 2> uv_middle{};  // Tells sheets of one patch apart, left and right of a seam.

  friend auto operator<=>(const Side&, const Side&) = default;
};

// Of the corners `a` and `b` of a triangle; the same bits for either order.
std::array<double, 2> uv_middle(const PatchSurface& surface, std::size_t t, std::size_t a,
                                std::size_t b)
{
  if (surface.triangle_uv.empty()) return {};
  const auto& uv = surface.triangle_uv[t];
  return {0.5 * (uv[a][0] + uv[b][0]), 0.5 * (uv[a][1] + uv[b][1])};
}

std::vector<Side> sides_of(const PatchSurface& surface)
{
  std::vector<Side> sides;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const PatchSurface::Triangle& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      sides.push_back({mesh::sorted_edge(v[c], v[(c + 1) % 3]), surface.triangle_patch[t],
                       uv_middle(surface, t, c, (c + 1) % 3)});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

// Calls visit(those of one edge) for each edge of sorted sides.
template <class Visit>
void for_each_edge(std::span<const Side> sides, const Visit& visit)
{
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    visit(sides.subspan(first, last - first));
    first = last;
  }
}

// Splits the triangles on one sheet of a patch at an edge, or all of the patch there.
void split_sheet(PatchSurface& surface, const Side& side, bool is_all)
{
  const auto [a, b] = side.edge;
  const auto middle = static_cast<LocalIndex>(surface.vertex_xyz.size());
  surface.vertex_xyz.push_back(midpoint(surface.vertex_xyz[at(a)], surface.vertex_xyz[at(b)]));
  surface.vertex_is_fixed.push_back(0);
  const std::size_t num_triangles = surface.triangles.size();
  for (std::size_t t = 0; t < num_triangles; ++t) {
    PatchSurface::Triangle& v = surface.triangles[t];
    const auto* const at_a = std::ranges::find(v, a);
    const auto* const at_b = std::ranges::find(v, b);
    if (surface.triangle_patch[t] != side.patch || at_a == v.end() || at_b == v.end()) continue;
    const auto corner_a = static_cast<std::size_t>(at_a - v.begin());
    const auto corner_b = static_cast<std::size_t>(at_b - v.begin());
    const std::array<double, 2> uv_new = uv_middle(surface, t, corner_a, corner_b);
    if (!is_all && uv_new != side.uv_middle) continue;
    PatchSurface::Triangle other = v;
    other[corner_a] = middle;
    v[corner_b] = middle;
    surface.triangles.push_back(other);
    surface.triangle_patch.push_back(side.patch);
    if (surface.triangle_uv.empty()) continue;
    auto uv = surface.triangle_uv[t];
    surface.triangle_uv[t][corner_b] = uv_new;
    uv[corner_a] = uv_new;
    surface.triangle_uv.push_back(uv);
  }
}

[[noreturn]] void throw_at(const PatchSurface& surface, const Edge& edge, std::size_t count)
{
  const Vec3& a = surface.vertex_xyz[at(edge[0])];
  const Vec3& b = surface.vertex_xyz[at(edge[1])];
  throw MeshError(fmt::format("the surface is not closed: {} triangles at the edge ({:g}) - ({:g})",
                              count, fmt::join(a, ", "), fmt::join(b, ", ")));
}

}  // namespace

void separate_patches(PatchSurface& surface)
{
  if (is_left_out(Repair::separated_sheets)) return;
  const std::vector<Side> all = sides_of(surface);
  for_each_edge(all, [&surface](std::span<const Side> sides) {
    if (std::ranges::binary_search(surface.edges, sides[0].edge)) return;
    for (std::size_t s = 1; s < sides.size(); ++s) {
      const LocalIndex patch = sides[s].patch;
      // Two triangles of one patch belong together, also at a pole, where their parameters differ.
      const bool is_all = std::ranges::count(sides, patch, &Side::patch) == 2;
      if (sides[s] == sides[s - 1] || (is_all && patch == sides[s - 1].patch)) continue;
      split_sheet(surface, sides[s], is_all);
      note_repair(Repair::separated_sheets);
    }
  });
}

void validate(const PatchSurface& surface)
{
  for_each_edge(sides_of(surface), [&surface](std::span<const Side> sides) {
    const bool is_on_curve = std::ranges::binary_search(surface.edges, sides[0].edge);
    const bool is_one_sheet = sides.size() == 2 && sides[0].patch == sides[1].patch;
    const bool is_closed = is_on_curve ? sides.size() >= 2 : is_one_sheet;
    if (!is_closed) throw_at(surface, sides[0].edge, sides.size());
  });
}

}  // namespace tessera::surface
