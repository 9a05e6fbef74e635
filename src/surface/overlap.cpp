// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/overlap.hpp"

#include <algorithm>
#include <utility>

#include "surface/crossings.hpp"

namespace tessera::surface {

std::vector<Overlap> find_overlaps(const PatchSurface& surface)
{
  std::vector<Box> boxes;
  boxes.reserve(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    boxes.push_back(box_of(surface.corners(t)));
  }
  const BoxTree tree(boxes);
  std::vector<Overlap> found;
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const PlacedTriangle one{surface.triangles[t], surface.corners(t)};
    tree.visit(
        [&](const Box& box) { return box.touches(boxes[t]); },
        [&](LocalIndex item) {
          const std::size_t other = at(item);
          if (other <= t) return;
          const auto place = crossing(one, {surface.triangles[other], surface.corners(other)});
          if (place) found.push_back({t, other, *place});
        });
  }
  std::ranges::sort(found, {}, [](const Overlap& one) { return std::pair(one.first, one.second); });
  return found;
}

std::vector<Overlap> forbidden_overlaps(const PatchSurface& surface, Forbidden forbidden)
{
  std::vector<Overlap> overlaps = find_overlaps(surface);
  if (forbidden == Forbidden::all_cuts) return overlaps;
  const auto materials_at = [&](std::size_t triangle) {
    return surface.patch_materials[at(surface.triangle_patch[triangle])];
  };
  std::erase_if(overlaps, [&](const Overlap& overlap) {
    const auto others = materials_at(overlap.second);
    return std::ranges::none_of(materials_at(overlap.first), [&](LocalIndex material) {
      return material != 0 && std::ranges::find(others, material) != others.end();
    });
  });
  return overlaps;
}

}  // namespace tessera::surface
