// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/patch_surface.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include "tessera/base/error.hpp"

namespace tessera::coarse {
namespace {

using Edge = PatchSurface::Edge;

struct Side {
  Edge edge{};
  LocalIndex patch = kNoIndex;

  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const PatchSurface& surface)
{
  std::vector<Side> sides;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const PatchSurface::Triangle& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(v[c], v[(c + 1) % 3]);
      sides.push_back({{low, high}, surface.triangle_patch[t]});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

[[noreturn]] void throw_at(const PatchSurface& surface, const Edge& edge, std::size_t count)
{
  const Vec3& a = surface.vertex_xyz[at(edge[0])];
  const Vec3& b = surface.vertex_xyz[at(edge[1])];
  std::ostringstream text;
  text << "the surface is not closed: " << count << " triangles at the edge (" << a[0] << ", "
       << a[1] << ", " << a[2] << ") - (" << b[0] << ", " << b[1] << ", " << b[2] << ")";
  throw MeshError(text.str());
}

}  // namespace

void validate(const PatchSurface& surface)
{
  const std::vector<Side> sides = sides_of(surface);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    const bool is_on_curve = std::ranges::binary_search(surface.edges, sides[first].edge);
    const bool is_inside =
        last - first == 2 && sides[first].patch == sides[last - 1].patch && !is_on_curve;
    if (!is_inside && !(is_on_curve && last - first >= 2)) {
      throw_at(surface, sides[first].edge, last - first);
    }
    first = last;
  }
}

}  // namespace tessera::coarse
