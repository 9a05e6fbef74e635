// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/surface_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tessera::coarse {
namespace {

using Corners = std::array<Vec3, 3>;

struct Box {
  Vec3 low{};
  Vec3 high{};
};

Box box_of(const Corners& corners)
{
  Box box{corners[0], corners[0]};
  for (const Vec3& corner : corners) {
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], corner[d]);
      box.high[d] = std::max(box.high[d], corner[d]);
    }
  }
  return box;
}

bool touch(const Box& a, const Box& b)
{
  for (std::size_t d = 0; d < 3; ++d) {
    if (a.high[d] < b.low[d] || b.high[d] < a.low[d]) return false;
  }
  return true;
}

// Six times the signed volume of a tet.
double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return dot(cross(b - a, c - a), d - a);
}

// Where the edge goes through the inside of the triangle.
std::optional<Vec3> piercing(const Vec3& from, const Vec3& to, const Corners& triangle)
{
  const double above = volume6(triangle[0], triangle[1], triangle[2], from);
  const double below = volume6(triangle[0], triangle[1], triangle[2], to);
  if (above * below >= 0.0) return std::nullopt;
  std::array<double, 3> sides{};
  for (std::size_t c = 0; c < 3; ++c) {
    sides[c] = volume6(from, to, triangle[c], triangle[(c + 1) % 3]);
  }
  const bool is_inside = (sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0)
                         || (sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0);
  if (!is_inside) return std::nullopt;
  return from + (above / (above - below)) * (to - from);
}

class OverlapSearch {
 public:
  explicit OverlapSearch(const PatchSurface& surface) : surface_(surface)
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      boxes_.push_back(box_of(surface.corners(t)));
      order_.push_back(t);
    }
    std::ranges::sort(order_, {}, [this](std::size_t t) { return boxes_[t].low[0]; });
  }

  // Sweeps a plane along x; only triangles that it cuts at the same time can meet.
  std::vector<Overlap> run()
  {
    std::vector<Overlap> found;
    std::vector<std::size_t> open;
    for (const std::size_t t : order_) {
      std::erase_if(open, [&](std::size_t o) { return boxes_[o].high[0] < boxes_[t].low[0]; });
      for (const std::size_t o : open) {
        if (!touch(boxes_[o], boxes_[t])) continue;
        if (const auto place = meet(o, t)) {
          found.push_back({std::min(o, t), std::max(o, t), *place});
        }
      }
      open.push_back(t);
    }
    std::ranges::sort(found, {},
                      [](const Overlap& one) { return std::pair(one.first, one.second); });
    return found;
  }

 private:
  [[nodiscard]] std::optional<Vec3> meet(std::size_t a, std::size_t b) const
  {
    const PatchSurface::Triangle& of_a = surface_.triangles[a];
    const PatchSurface::Triangle& of_b = surface_.triangles[b];
    const auto num_shared = std::ranges::count_if(
        of_a, [&](LocalIndex v) { return std::ranges::find(of_b, v) != of_b.end(); });
    if (num_shared > 1) return std::nullopt;
    const auto place = edge_through(of_a, b);
    return place ? place : edge_through(of_b, a);
  }

  // An edge that begins at a corner of the triangle does not go through it.
  [[nodiscard]] std::optional<Vec3> edge_through(const PatchSurface::Triangle& edges_of,
                                                 std::size_t t) const
  {
    const PatchSurface::Triangle& v = surface_.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex from = edges_of[c];
      const LocalIndex to = edges_of[(c + 1) % 3];
      const auto is_end = [&](LocalIndex corner) { return corner == from || corner == to; };
      if (std::ranges::any_of(v, is_end)) continue;
      const auto place =
          piercing(surface_.vertex_xyz[at(from)], surface_.vertex_xyz[at(to)], surface_.corners(t));
      if (place) return place;
    }
    return std::nullopt;
  }

  const PatchSurface& surface_;
  std::vector<Box> boxes_{};
  std::vector<std::size_t> order_{};
};

}  // namespace

std::vector<Overlap> find_overlaps(const PatchSurface& surface)
{
  return OverlapSearch(surface).run();
}

}  // namespace tessera::coarse
