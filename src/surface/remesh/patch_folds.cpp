// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/patch_folds.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"

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
      : surface_(surface), reference_(reference), model_(model)
  {
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
      curves_.emplace(surface.edges[e], surface.edge_curve[e]);
    }
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
  // Where refinement puts the vertex of a side: found once for the two triangles there, as patches
  // meet along curves only.
  [[nodiscard]] Vec3 middle_of(std::size_t t, std::size_t side)
  {
    const PatchSurface::Triangle& v = surface_.triangles[t];
    const Edge edge = edge_of(v[side], v[(side + 1) % 3]);
    const auto known = middles_.find(edge);
    if (known != middles_.end()) return known->second;
    return middles_.emplace(edge, found_middle(edge, surface_.triangle_patch[t])).first->second;
  }

  // What cannot be projected counts as straight.
  [[nodiscard]] Vec3 found_middle(const Edge& edge, LocalIndex patch)
  {
    const Vec3 chord = midpoint(surface_.vertex_xyz[at(edge[0])], surface_.vertex_xyz[at(edge[1])]);
    const auto curve = curves_.find(edge);
    const auto middle = projections_.run<GeometryError>([&] {
      return curve == curves_.end() ? on_surface(patch, chord) : on_curve(curve->second, chord);
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
  std::map<Edge, LocalIndex> curves_{};
  std::map<Edge, Vec3> middles_{};
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
