// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/wall_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tessera/base/repair.hpp"

#include "coarse/box_tree.hpp"
#include "coarse/surface_sizes.hpp"

namespace tessera::coarse {
namespace {

using Corners = std::array<Vec3, 3>;
using Triangle = PatchSurface::Triangle;

// Parts of the largest size: less than kLeastOfWall, as a surface that cuts itself is no use at
// all.
constexpr double kLeastOfChord = 0.02;

// The chords of a triangle with edges h on a radius R are off by h^2 / (6 R).
constexpr double kPartOfGap = 0.25;

// How far to look, in parts of the largest size: beyond it no wall limits anything, unless fewer
// than two edges a radius are asked for.
constexpr double kReach = 0.35;

// Sheets that face each other: their normals are less than 60 degrees apart.
constexpr double kLeastCosine = 0.5;

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
  const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
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
            const std::vector<std::array<LocalIndex, 2>>& patch_materials,
            const CoarseOptions& options)
      : surface_(surface),
        patch_materials_(patch_materials),
        options_(options),
        reach_(kReach * options.max_size),
        tree_(boxes_of(surface))
  {
    for (LocalIndex v = 0; v < surface.num_vertices(); ++v) sizes_.push_back(surface.size(v));
    for (const auto& [edge, curve] : surface.curves()) {
      const std::vector<LocalIndex> sheets = surface.triangles_at(edge);
      for (const LocalIndex a : sheets) {
        for (const LocalIndex b : sheets) joined_.emplace(surface.patch(a), surface.patch(b));
      }
    }
  }

  std::vector<double> run() &&
  {
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (surface_.is_triangle(t)) look(t);
    }
    Neighbours neighbours(sizes_.size());
    std::vector<Vec3> xyz;
    for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) {
      neighbours[at(v)] = surface_.neighbours(v);
      xyz.push_back(surface_.xyz(v));
    }
    grade(xyz, neighbours, options_.grading, sizes_);
    return std::move(sizes_);
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
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (norm(normal) == 0.0) return;
    const Vec3 middle = (1.0 / 3.0) * (p[0] + p[1] + p[2]);
    const Vec3 up = (reach_ / norm(normal)) * normal;
    const auto& materials = patch_materials_[at(surface_.patch(t))];
    limit(t, {middle, -1.0 * up}, materials[0] != 0);
    limit(t, {middle, up}, materials[1] != 0);
  }

  void limit(LocalIndex t, const Ray& ray, bool is_material)
  {
    double nearest = kInfinity;
    LocalIndex wall = kNoIndex;
    tree_.visit([&](const Box& box) { return touches(ray, box); },
                [&](LocalIndex other) {
                  if (share_a_corner(surface_.triangle(other), surface_.triangle(t))) return;
                  const double found = hit(ray, surface_.corners(other));
                  if (found >= nearest) return;
                  nearest = found;
                  wall = other;
                });
    if (wall == kNoIndex) return;
    const double gap = nearest * reach_;
    // Sheets that meet in a curve have an angle there that no size makes better.
    const bool is_wall = surface_.patch(t) == surface_.patch(wall)
                         || !joined_.contains(std::pair(surface_.patch(t), surface_.patch(wall)));
    for (const LocalIndex v : surface_.triangle(t)) {
      double size = chord_limit(surface_.size(v), gap);
      if (is_material && is_wall) {
        size = std::min(size, std::max(kEdgesOfWall * gap, kLeastOfWall * options_.max_size));
      }
      sizes_[at(v)] = std::min(sizes_[at(v)], size);
    }
  }

  // Sizes that are not the largest one come from a radius.
  [[nodiscard]] double chord_limit(double size, double gap) const
  {
    constexpr double kFlat = 0.99;
    if (size > kFlat * options_.max_size) return size;
    const double radius = options_.curvature * size;
    return std::max(std::sqrt(6.0 * radius * kPartOfGap * gap), kLeastOfChord * options_.max_size);
  }

  const EditableSurface& surface_;
  const std::vector<std::array<LocalIndex, 2>>& patch_materials_;
  const CoarseOptions& options_;
  double reach_;
  BoxTree tree_;
  std::vector<double> sizes_{};
  std::set<std::pair<LocalIndex, LocalIndex>> joined_{};  // Patches that share a curve.
};

}  // namespace

std::vector<double> wall_sizes(const EditableSurface& surface,
                               const std::vector<std::array<LocalIndex, 2>>& patch_materials,
                               const CoarseOptions& options)
{
  std::vector<double> sizes = WallSizes(surface, patch_materials, options).run();
  GlobalIndex num_smaller = 0;
  for (LocalIndex v = 0; v < surface.num_vertices(); ++v) {
    if (sizes[at(v)] < surface.size(v)) ++num_smaller;
  }
  note_repair(Repair::wall_sizes, num_smaller);
  return sizes;
}

}  // namespace tessera::coarse
