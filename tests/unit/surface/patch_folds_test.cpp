// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/patch_folds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/surface/on_geometry.hpp"

#include "surface/remesh/remesh.hpp"

namespace tessera::surface {
namespace {

// A cylinder of radius 1, and on it one that is a little thinner: between them is a narrow ledge.
// Surfaces, from below: bottom, wide mantle, ledge, thin mantle, top. Curves: the four circles.
constexpr std::array<double, 4> kRadii{1.0, 1.0, 0.995, 0.995};
constexpr std::array<double, 4> kHeights{0.0, 1.0, 1.0, 2.0};

Vec3 on_circle(const Vec3& point, double radius, double z)
{
  const double scale = radius / std::hypot(point[0], point[1]);
  return {scale * point[0], scale * point[1], z};
}

class LedgeModel final : public model::Model {
 public:
  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters&) const override
  {
    if (surface % 2 == 0) return {point, {}};
    return {on_circle(point, kRadii.at(at(surface)), point[2]), {}};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double) const override
  {
    return {on_circle(point, kRadii.at(at(curve)), kHeights.at(at(curve))), 0.0};
  }
  [[nodiscard]] double box_diagonal() const override { return 4.0; }
};

void add_disc(LocalIndex first, LocalIndex n, bool looks_up, LocalIndex patch, PatchSurface& to)
{
  for (LocalIndex i = 1; i + 1 < n; ++i) {
    const LocalIndex a = first + (looks_up ? i : i + 1);
    const LocalIndex b = first + (looks_up ? i + 1 : i);
    to.triangles.push_back({first, a, b});
    to.triangle_patch.push_back(patch);
  }
}

PatchSurface ledge(LocalIndex n)
{
  PatchSurface surface;
  for (LocalIndex ring = 0; ring < 4; ++ring) {
    for (LocalIndex i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      surface.vertex_xyz.push_back(on_circle({std::cos(angle), std::sin(angle), 0.0},
                                             kRadii.at(at(ring)), kHeights.at(at(ring))));
    }
    for (LocalIndex i = 0; i < n; ++i) {
      const LocalIndex a = n * ring + i;
      const LocalIndex b = n * ring + (i + 1) % n;
      surface.edges.push_back({std::min(a, b), std::max(a, b)});
      surface.edge_curve.push_back(ring);
      if (ring == 3) continue;
      surface.triangles.push_back({a, b, b + n});
      surface.triangles.push_back({a, b + n, a + n});
      surface.triangle_patch.insert(surface.triangle_patch.end(), 2, ring + 1);
    }
  }
  add_disc(0, n, false, 0, surface);
  add_disc(3 * n, n, true, 4, surface);
  // Ascending within each ring but for the edge that closes it.
  for (LocalIndex ring = 0; ring < 4; ++ring) {
    const auto begin = surface.edges.begin() + n * ring;
    std::sort(begin, begin + n);
  }
  surface.vertex_is_fixed.assign(surface.vertex_xyz.size(), 0);
  surface.patch_materials.assign(5, {1, 0});
  return surface;
}

CoarseOptions large()
{
  CoarseOptions options;
  options.max_size = 4.0;
  return options;
}

TEST(PatchFolds, AreFoundWhereAnArcIsHigherThanItsStripIsWide)
{
  const LedgeModel model;
  const SurfaceReference coarse(ledge(8));
  EXPECT_FALSE(folding_triangles(coarse.surface(), coarse, model).empty())
      << "arcs of 45 degrees are 0.08 high";
  const SurfaceReference fine(ledge(64));
  EXPECT_TRUE(folding_triangles(fine.surface(), fine, model).empty());
}

TEST(PatchFolds, AreNotLeftByTheRemesher)
{
  const LedgeModel model;
  const SurfaceReference reference(ledge(64));
  PatchSurface before = remesh(reference, reference.surface(), SizeFunction(large())).surface;
  put_on_geometry(before, reference, model);
  ASSERT_FALSE(folding_triangles(before, reference, model).empty());

  const PatchSurface after = remesh_on_geometry(reference, model, large()).surface;
  EXPECT_NO_THROW(validate(after));
  EXPECT_TRUE(folding_triangles(after, reference, model).empty());
  EXPECT_LT(after.triangles.size(), 10 * before.triangles.size());
}

}  // namespace
}  // namespace tessera::surface
