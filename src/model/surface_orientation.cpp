// SPDX-License-Identifier: BSD-3-Clause
#include "surface_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/half_edges.hpp"
#include "tessera/model/winding.hpp"

namespace tessera::model {
namespace {

Box box_around(const TriangleSurface& surface, const Shell& shell)
{
  Box box;
  for (const LocalIndex t : shell.triangles) box.include(box_of(surface.corners(t)));
  return box;
}

// Walks from triangle to triangle over shared edges, and marks those that must be turned to agree
// with the first of their shell.
class ShellWalk {
 public:
  ShellWalk(const TriangleSurface& surface, std::span<const LocalIndex> opposite,
            const std::string& name)
      : surface_(surface),
        opposite_(opposite),
        name_(name),
        reached_(at(surface.num_triangles())),
        turned_(at(surface.num_triangles()))
  {
  }

  std::vector<Shell> walk()
  {
    std::vector<Shell> shells;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (!reached_[at(t)]) shells.push_back(walk_from(t));
    }
    return shells;
  }

  [[nodiscard]] const std::vector<bool>& turned() const { return turned_; }

 private:
  Shell walk_from(LocalIndex start)
  {
    Shell shell;
    shell.triangles.push_back(start);
    reached_[at(start)] = true;
    for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
      const LocalIndex t = shell.triangles[i];
      for (LocalIndex h = 3 * t; h < 3 * t + 3; ++h) {
        const LocalIndex other = opposite_[at(h)] / 3;
        const bool turn_other = turned_[at(t)] != same_direction(h);
        if (!reached_[at(other)]) {
          reached_[at(other)] = true;
          turned_[at(other)] = turn_other;
          shell.triangles.push_back(other);
        } else if (turned_[at(other)] != turn_other) {
          refuse_one_sided(h);
        }
      }
    }
    std::sort(shell.triangles.begin(), shell.triangles.end());
    return shell;
  }

  // Whether h and its opposite run the same way, which neighbours that agree never do.
  [[nodiscard]] bool same_direction(LocalIndex h) const
  {
    return surface_.triangle_vertices[at(h)] == surface_.triangle_vertices[at(opposite_[at(h)])];
  }

  [[noreturn]] void refuse_one_sided(LocalIndex h) const
  {
    const Vec3 p = surface_.position(surface_.triangle_vertices[at(h)]);
    throw GeometryError(fmt::format(
        "{}: surface is one-sided (as a Moebius strip), so it bounds no body; near ({:g})", name_,
        fmt::join(p, ", ")));
  }

  const TriangleSurface& surface_;
  std::span<const LocalIndex> opposite_;
  const std::string& name_;
  std::vector<bool> reached_;
  std::vector<bool> turned_;
};

void turn(TriangleSurface& surface, LocalIndex t)
{
  const std::size_t row = 3 * at(t);
  std::swap(surface.triangle_vertices[row + 1], surface.triangle_vertices[row + 2]);
}

// Measured from a corner of the shell, so that a small body far from the origin keeps its digits.
double enclosed_volume(const TriangleSurface& surface, const Shell& shell)
{
  const Vec3 origin = surface.corners(shell.triangles.front())[0];
  double volume = 0.0;
  for (const LocalIndex t : shell.triangles) {
    const auto [a, b, c] = surface.corners(t);
    volume += tet_volume(origin, a, b, c);
  }
  return volume;
}

bool is_inside(const TriangleSurface& surface, const Shell& shell, const Vec3& p)
{
  double angle = 0.0;
  for (const LocalIndex t : shell.triangles) angle += solid_angle(surface.corners(t), p);
  return std::abs(angle) > 2.0 * std::numbers::pi;  // 4 pi inside, 0 outside
}

void nest(const TriangleSurface& surface, std::vector<Shell>& shells)
{
  std::vector<Box> boxes;
  for (const Shell& shell : shells) boxes.push_back(box_around(surface, shell));
  std::vector<std::vector<LocalIndex>> containers(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const Vec3 probe = middle_of(surface.corners(shells[s].triangles.front()));
    for (std::size_t other = 0; other < shells.size(); ++other) {
      if (other == s || !boxes[other].holds(probe)) continue;
      if (is_inside(surface, shells[other], probe)) {
        containers[s].push_back(static_cast<LocalIndex>(other));
      }
    }
    shells[s].depth = static_cast<LocalIndex>(containers[s].size());
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    for (const LocalIndex c : containers[s]) {
      if (shells[at(c)].depth == shells[s].depth - 1) shells[s].parent = c;
    }
  }
}

bool is_inside_out(const TriangleSurface& surface, const Shell& shell, const std::string& name)
{
  constexpr double kFlat = 1e-12;  // far below what single precision leaves of a flat shell
  const double diagonal = box_around(surface, shell).diagonal();
  const double volume = enclosed_volume(surface, shell);
  if (std::abs(volume) <= kFlat * std::pow(diagonal, 3)) {
    throw GeometryError(
        fmt::format("{}: shell of {} triangles encloses no volume", name, shell.triangles.size()));
  }
  return (volume > 0.0) != (shell.depth % 2 == 0);
}

}  // namespace

Orientation orient(TriangleSurface& surface, std::span<const LocalIndex> opposite,
                   const std::string& name)
{
  ShellWalk walk(surface, opposite, name);
  Orientation result;
  result.shells = walk.walk();
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    if (walk.turned()[at(t)]) turn(surface, t);
  }
  nest(surface, result.shells);
  for (const Shell& shell : result.shells) {
    const bool inside_out = is_inside_out(surface, shell, name);
    if (inside_out) {
      for (const LocalIndex t : shell.triangles) turn(surface, t);
    }
    // Against the file: either a few were turned, or the whole shell but for a few.
    const auto num_changed = static_cast<LocalIndex>(
        std::count_if(shell.triangles.begin(), shell.triangles.end(),
                      [&](LocalIndex t) { return walk.turned()[at(t)] != inside_out; }));
    const auto num_triangles = static_cast<LocalIndex>(shell.triangles.size());
    if (2 * num_changed > num_triangles) ++result.num_turned_shells;
    result.num_turned += std::min(num_changed, num_triangles - num_changed);
  }
  return result;
}

}  // namespace tessera::model
