// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sizes/wall_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tessera/base/box_tree.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/triangle.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;
using Triangle = PatchSurface::Triangle;

// How far to look, in parts of the largest size: beyond it no wall limits anything.
constexpr double kReach = 1.0 / kEdgesOfWall;

// Sheets that face each other: their normals are less than 60 degrees apart.
constexpr double kLeastCosine = 0.5;

// In parts of the reach: rounding moves the end of a ray by far less.
constexpr double kSlack = 1e-6;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ray {
  Vec3 from{};
  Vec3 along{};  // As long as the ray.
};

bool touches(const Ray& ray, const Box& box)
{
  double first = 0.0;
  double last = 1.0;
  for (std::size_t d = 0; d < 3; ++d) {
    if (ray.along[d] == 0.0) {
      if (ray.from[d] < box.low[d] || ray.from[d] > box.high[d]) return false;
      continue;
    }
    const double a = (box.low[d] - ray.from[d]) / ray.along[d];
    const double b = (box.high[d] - ray.from[d]) / ray.along[d];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

// Where along the ray, in [0, 1], it goes through the triangle; infinity if it does not.
double hit(const Ray& ray, const Corners& p)
{
  const Vec3 normal = normal_of(p);
  const double slope = dot(normal, ray.along);
  if (std::abs(slope) < kLeastCosine * norm(normal) * norm(ray.along)) return kInfinity;
  const double at_plane = dot(normal, p[0] - ray.from) / slope;
  if (at_plane < 0.0 || at_plane > 1.0) return kInfinity;
  const Vec3 point = ray.from + at_plane * ray.along;
  for (std::size_t c = 0; c < 3; ++c) {
    if (dot(normal, cross(p[(c + 1) % 3] - p[c], point - p[c])) < 0.0) return kInfinity;
  }
  return at_plane;
}

bool share_a_corner(const Triangle& a, const Triangle& b)
{
  return std::ranges::any_of(a, [&](LocalIndex v) { return std::ranges::find(b, v) != b.end(); });
}

class WallSizes {
 public:
  WallSizes(const EditableSurface& surface,
            const std::vector<std::array<LocalIndex, 2>>& patch_materials, double largest)
      : surface_(surface),
        patch_materials_(patch_materials),
        largest_(largest),
        reach_(kReach * largest),
        tree_(boxes_of(surface))
  {
    for (const auto& [edge, curve] : surface.curves()) {
      const std::vector<LocalIndex> sheets = surface.triangles_at(edge);
      for (const LocalIndex a : sheets) {
        for (const LocalIndex b : sheets) joined_.emplace(surface.patch(a), surface.patch(b));
      }
    }
  }

  std::vector<SizeSource> run() &&
  {
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (surface_.is_triangle(t)) look(t);
    }
    return std::move(sources_);
  }

 private:
  static std::vector<Box> boxes_of(const EditableSurface& surface)
  {
    std::vector<Box> boxes(at(surface.num_triangles()));
    for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
      if (surface.is_triangle(t)) boxes[at(t)] = box_of(surface.corners(t));
    }
    return boxes;
  }

  // Both ways from the middle of a triangle.
  void look(LocalIndex t)
  {
    const Corners p = surface_.corners(t);
    const Vec3 normal = normal_of(p);
    if (norm(normal) == 0.0) return;
    const Vec3 middle = middle_of(p);
    const Vec3 up = (reach_ / norm(normal)) * normal;
    const auto& materials = patch_materials_[at(surface_.patch(t))];
    if (materials[0] != 0) limit(t, {middle, -1.0 * up});
    if (materials[1] != 0) limit(t, {middle, up});
  }

  void limit(LocalIndex t, const Ray& ray)
  {
    double nearest = kInfinity;
    LocalIndex wall = kNoIndex;
    // Most boxes are ruled out without the divisions that tell a ray from its own box.
    const Box around = box_of(std::array{ray.from, ray.from + ray.along}).widened(kSlack * reach_);
    tree_.visit([&](const Box& box) { return box.touches(around) && touches(ray, box); },
                [&](LocalIndex other) {
                  if (share_a_corner(surface_.triangle(other), surface_.triangle(t))) return;
                  const double found = hit(ray, surface_.corners(other));
                  if (found >= nearest) return;
                  nearest = found;
                  wall = other;
                });
    if (wall == kNoIndex) return;
    const bool is_wall = surface_.patch(t) == surface_.patch(wall)
                         || !joined_.contains(std::pair(surface_.patch(t), surface_.patch(wall)));
    if (!is_wall) return;
    const double size = kEdgesOfWall * nearest * reach_;
    sources_.push_back({surface_.corners(t), std::max(size, kLeastOfWall * largest_)});
  }

  const EditableSurface& surface_;
  const std::vector<std::array<LocalIndex, 2>>& patch_materials_;
  double largest_;
  double reach_;
  BoxTree tree_;
  std::vector<SizeSource> sources_{};
  std::set<std::pair<LocalIndex, LocalIndex>> joined_{};  // Patches that share a curve.
};

}  // namespace

std::vector<SizeSource> thin_walls_of(const EditableSurface& surface,
                                      const std::vector<std::array<LocalIndex, 2>>& patch_materials,
                                      double largest)
{
  std::vector<SizeSource> sources = WallSizes(surface, patch_materials, largest).run();
  note_repair(Repair::wall_sizes, static_cast<GlobalIndex>(sources.size()));
  return sources;
}

}  // namespace tessera::surface
