// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/patch_folds.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "surface/editable_surface.hpp"
#include "surface/model_curve.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;
using Corners = std::array<Vec3, 3>;

// A child whose normal is farther off that of its parent than this cosine says, leaves no room for
// the tets below it.
constexpr double kLeastCosine = 0.2;

class FoldFinder {
 public:
  FoldFinder(const PatchSurface& surface, const SurfaceReference& reference,
             const model::Model& model)
      : surface_(surface), reference_(reference), model_(model), middles_(surface.vertex_xyz.size())
  {
  }

  [[nodiscard]] bool folds(std::size_t t)
  {
    const Corners p = surface_.corners(t);
    const Vec3 whole = normal_of(p);
    const auto children = children_of(p, {middle_of(t, 0), middle_of(t, 1), middle_of(t, 2)});
    return std::ranges::any_of(children, [&](const Corners& child) {
      const Vec3 normal = normal_of(child);
      return dot(normal, whole) <= kLeastCosine * norm(normal) * norm(whole);
    });
  }

 private:
  struct Middle {
    LocalIndex end = kNoIndex;  // The edge's higher vertex.
    Vec3 xyz{};
  };

  // Where refinement puts the vertex of a side: found once for the two triangles there, as patches
  // meet along curves only.
  [[nodiscard]] Vec3 middle_of(std::size_t t, std::size_t side)
  {
    const PatchSurface::Triangle& v = surface_.triangles[t];
    const Edge edge = mesh::sorted_edge(v[side], v[(side + 1) % 3]);
    std::vector<Middle>& known = middles_[at(edge[0])];
    const auto same = std::ranges::find(known, edge[1], &Middle::end);
    if (same != known.end()) return same->xyz;
    return known.emplace_back(Middle{edge[1], found_middle(edge, surface_.triangle_patch[t])}).xyz;
  }

  // What cannot be projected counts as straight.
  [[nodiscard]] Vec3 found_middle(const Edge& edge, LocalIndex patch)
  {
    const Vec3 chord = midpoint(surface_.vertex_xyz[at(edge[0])], surface_.vertex_xyz[at(edge[1])]);
    const auto row = std::ranges::lower_bound(surface_.edges, edge);
    const bool is_on_curve = row != surface_.edges.end() && *row == edge;
    const auto e = static_cast<std::size_t>(row - surface_.edges.begin());
    const auto middle = projections_.run<GeometryError>([&] {
      return is_on_curve ? on_curve(surface_.edge_curve[e], chord) : on_surface(patch, chord);
    });
    return middle.value_or(chord);
  }

  [[nodiscard]] Vec3 on_surface(LocalIndex patch, const Vec3& point) const
  {
    return model_.project_to_surface(patch, point, reference_.parameters(patch, point)).xyz;
  }

  [[nodiscard]] Vec3 on_curve(LocalIndex curve, const Vec3& point) const
  {
    return on_model_curve(reference_, model_, curve, point);
  }

  const PatchSurface& surface_;
  const SurfaceReference& reference_;
  const model::Model& model_;
  std::vector<std::vector<Middle>> middles_;  // Known ones, at the lower vertex of each edge.
  Attempts projections_{"middles of edges on the geometry, to find folds"};
};

}  // namespace

std::vector<std::size_t> folding_triangles(const PatchSurface& surface,
                                           const SurfaceReference& reference,
                                           const model::Model& model)
{
  FoldFinder finder(surface, reference, model);
  std::vector<std::size_t> folding;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (finder.folds(t)) folding.push_back(t);
  }
  return folding;
}

}  // namespace tessera::surface
