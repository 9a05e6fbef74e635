// SPDX-License-Identifier: BSD-3-Clause
#include "surface/wrap/caps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

#include "tessera/base/cheapest_triangulation.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/base/types.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/model/winding.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;
using Loop = std::vector<Vec3>;

// The time goes with the third power: 0.1 s for so many.
constexpr std::size_t kMostCorners = 400;

// Of winding numbers at a cap, on average by area: they are 1/2 at a flat cap of a hole in a closed
// surface, and whole numbers where no boundary is missing.
constexpr double kLeastWinding = 0.25;
constexpr double kMostWinding = 0.75;

// Of the tolerance: a wall that is left of a body must be some cells thick.
constexpr double kMostNear = 2.0;

// Walks along the edges that only one triangle has, with the hole to the left.
class Rims {
 public:
  explicit Rims(std::span<const Corners> triangles)
  {
    for (const Corners& p : triangles) {
      for (std::size_t c = 0; c < 3; ++c) add(id_of(p[c]), id_of(p[(c + 1) % 3]));
    }
    for (const auto& [edge, count] : open_)
      next_[edge.second].insert(next_[edge.second].end(), at(count), edge.first);
  }

  std::vector<Loop> loops()
  {
    for (auto& [start, ends] : next_) {
      while (!ends.empty()) walk_from(start);
    }
    return std::move(loops_);
  }

 private:
  LocalIndex id_of(const Vec3& p)
  {
    const auto [place, is_new] = ids_.emplace(p, static_cast<LocalIndex>(xyz_.size()));
    if (is_new) {
      xyz_.push_back(p);
      is_on_path_.push_back(false);
    }
    return place->second;
  }

  // Two that run against each other are an edge within the surface.
  void add(LocalIndex from, LocalIndex to)
  {
    const auto reverse = open_.find({to, from});
    if (reverse == open_.end()) {
      ++open_[{from, to}];
    } else if (--reverse->second == 0) {
      open_.erase(reverse);
    }
  }

  // Where the walk meets itself, a loop is complete. A walk that gets stuck bounds nothing.
  void walk_from(LocalIndex start)
  {
    std::vector<LocalIndex> path{start};
    is_on_path_[at(start)] = true;
    while (!path.empty()) {
      std::vector<LocalIndex>& ends = next_[path.back()];
      if (ends.empty()) {
        is_on_path_[at(path.back())] = false;
        path.pop_back();
        continue;
      }
      const LocalIndex to = ends.back();
      ends.pop_back();
      if (!is_on_path_[at(to)]) {
        is_on_path_[at(to)] = true;
        path.push_back(to);
        continue;
      }
      Loop& loop = loops_.emplace_back();
      for (; path.back() != to; path.pop_back()) {
        loop.push_back(xyz_[at(path.back())]);
        is_on_path_[at(path.back())] = false;
      }
      loop.push_back(xyz_[at(to)]);
      std::ranges::reverse(loop);
    }
  }

  std::map<Vec3, LocalIndex> ids_{};
  std::vector<Vec3> xyz_{};
  std::map<std::pair<LocalIndex, LocalIndex>, LocalIndex> open_{};
  std::map<LocalIndex, std::vector<LocalIndex>> next_{};
  std::vector<bool> is_on_path_{};
  std::vector<Loop> loops_{};
};

// What a cap must leave alone.
struct Surface {
  const FileTriangles& file;
  model::WindingNumbers winding;
  double tolerance;
};

// The triangulation of a loop with the least area. No chord lies on the surface beyond the rim:
// what is left there would have no thickness.
class LeastArea {
 public:
  LeastArea(const Loop& loop, const Surface& surface)
      : loop_(loop), surface_(surface), rim_(edges_of(loop)), least_(triangulation())
  {
  }

  // False if there is no such triangulation. The order is that of the stack: sums over triangles
  // depend on it.
  [[nodiscard]] bool add_to(std::vector<Corners>& cap) const
  {
    if (!std::isfinite(least_.cost())) return false;
    std::vector<std::pair<std::size_t, std::size_t>> chords{{0, loop_.size() - 1}};
    while (!chords.empty()) {
      const auto [i, k] = chords.back();
      chords.pop_back();
      if (k < i + 2) continue;
      const std::size_t j = least_.apex(i, k);
      cap.push_back({loop_[i], loop_[j], loop_[k]});
      chords.insert(chords.end(), {{i, j}, {j, k}});
    }
    return true;
  }

 private:
  static std::vector<std::array<Vec3, 2>> edges_of(const Loop& loop)
  {
    std::vector<std::array<Vec3, 2>> edges;
    for (std::size_t i = 0; i < loop.size(); ++i)
      edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
    return edges;
  }

  [[nodiscard]] CheapestTriangulation<> triangulation() const
  {
    const auto is_apart = [this](std::size_t i, std::size_t k) {
      return !lies_on_surface(midpoint(loop_[i], loop_[k]));
    };
    return {loop_.size(), is_apart,
            [this](double behind, std::size_t i, std::size_t j, std::size_t k) {
              return behind + triangle_area(loop_[i], loop_[j], loop_[k]);
            }};
  }

  [[nodiscard]] bool lies_on_surface(const Vec3& point) const
  {
    const double near = kMostNear * surface_.tolerance;
    const Vec3 foot = surface_.file.search.nearest(point).xyz;
    return norm(foot - point) < near && norm(rim_.nearest(foot).xyz - foot) > near;
  }

  const Loop& loop_;
  const Surface& surface_;
  model::SegmentSearch rim_;
  CheapestTriangulation<> least_;
};

// Of a rim that is too long, every so manieth corner is taken, and fans close the rest. Empty if
// there is none.
std::vector<Corners> cap_of(const Loop& rim, const Surface& surface)
{
  const std::size_t step = (rim.size() + kMostCorners - 1) / kMostCorners;
  Loop loop;
  std::vector<Corners> cap;
  for (std::size_t i = 0; i < rim.size(); i += step) {
    loop.push_back(rim[i]);
    const std::size_t end = std::min(i + step, rim.size());
    for (std::size_t j = i + 1; j < end; ++j)
      cap.push_back({rim[i], rim[j], rim[(j + 1) % rim.size()]});
  }
  if (!LeastArea(loop, surface).add_to(cap)) return {};
  return cap;
}

bool is_of_hole(const std::vector<Corners>& cap, const Surface& surface)
{
  double farthest = 0.0;
  double area = 0.0;
  double sum = 0.0;
  for (const Corners& triangle : cap) {
    const Vec3 middle = middle_of(triangle);
    farthest = std::max(farthest, surface.file.distance(middle));
    area += triangle_area(triangle);
    sum += triangle_area(triangle) * surface.winding.at(middle);
  }
  return farthest > surface.tolerance && sum > kLeastWinding * area && sum < kMostWinding * area;
}

}  // namespace

std::vector<Corners> hole_caps(const FileTriangles& file, double tolerance)
{
  const Surface surface{file, model::WindingNumbers(file.triangles), tolerance};
  std::vector<Corners> caps;
  for (const Loop& rim : Rims(file.triangles).loops()) {
    if (rim.size() < 3) continue;
    const std::vector<Corners> cap = cap_of(rim, surface);
    if (is_of_hole(cap, surface)) caps.insert(caps.end(), cap.begin(), cap.end());
  }
  return caps;
}

}  // namespace tessera::surface
