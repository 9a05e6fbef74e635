// SPDX-License-Identifier: BSD-3-Clause
#include "support/patch_surfaces.hpp"

#include <algorithm>

namespace tessera::testing {

void add_patch(const model::TriangleSoup& soup, double scale, const Vec3& shift,
               surface::PatchSurface& surface)
{
  const LocalIndex patch = surface.num_patches();
  for (std::size_t i = 0; i < soup.corner_xyz.size(); i += 9) {
    surface::PatchSurface::Triangle v{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double* x = &soup.corner_xyz[i + 3 * c];
      const Vec3 point = scale * Vec3{x[0], x[1], x[2]} + shift;
      const auto known = std::ranges::find(surface.vertex_xyz, point);
      v[c] = static_cast<LocalIndex>(known - surface.vertex_xyz.begin());
      if (known == surface.vertex_xyz.end()) surface.vertex_xyz.push_back(point);
    }
    surface.triangles.push_back(v);
    surface.triangle_patch.push_back(patch);
  }
  surface.vertex_is_fixed.assign(surface.vertex_xyz.size(), 0);
  surface.patch_materials.push_back({1, 0});
}

}  // namespace tessera::testing
