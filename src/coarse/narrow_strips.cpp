// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/narrow_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "tessera/base/repair.hpp"

#include "coarse/wall_sizes.hpp"

namespace tessera::coarse {
namespace {

// A triangle is a needle if its height is less than this part of its longest edge: 6 degrees.
constexpr double kNeedle = 0.1;

// A new edge along a strip costs about so many tets, with those between it and larger edges. The
// finer mesh may have so many times the tets of the first one.
constexpr double kTetsPerEdge = 40.0;
constexpr double kFewTets = 3e4;
constexpr double kMostGrowth = 2.0;

// The longest edge of a triangle, and the distance of its third corner from it.
struct Needle {
  Vec3 from{};
  Vec3 along{};
  double width = 0.0;
};

Needle needle_of(const std::array<Vec3, 3>& p)
{
  Needle needle;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 edge = p[(c + 1) % 3] - p[c];
    if (norm(edge) > norm(needle.along)) needle = {p[c], edge, 0.0};
  }
  needle.width = norm(cross(p[1] - p[0], p[2] - p[0])) / norm(needle.along);
  return needle;
}

class StripFinder {
 public:
  StripFinder(const mesh::CoarseMesh& mesh, const VertexPatches& patches,
              const std::vector<LocalIndex>& sharp)
      : mesh_(mesh), patches_(patches)
  {
    for (const LocalIndex t : sharp) {
      for (const LocalIndex v : mesh.tet(t)) near_.insert(v);
    }
  }

  mesh::SizePoints run(const StripLimits& limits)
  {
    const double grown = mesh_.num_tets() - limits.num_first_tets;
    const double most = std::max(kFewTets, kMostGrowth * limits.num_first_tets);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (is_between_curves(f)) add(needle_of(corners(f)), limits.least_size);
      if (grown + kTetsPerEdge * num_edges_ > most) return {};
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] bool is_between_curves(LocalIndex f) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    return std::all_of(v, v + 3, [&](LocalIndex i) { return patches_[at(i)].size() > 1; })
           && std::any_of(v, v + 3, [&](LocalIndex i) { return near_.contains(i); });
  }

  [[nodiscard]] std::array<Vec3, 3> corners(LocalIndex f) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    return {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
  }

  void add(const Needle& needle, double least_size)
  {
    const double length = norm(needle.along);
    if (needle.width > kNeedle * length) return;
    const double size = std::max(kEdgesOfWall * needle.width, least_size);
    if (size >= length) return;
    const double num_edges = std::ceil(length / size);
    num_edges_ += num_edges;
    for (double i = 0.0; i <= num_edges; ++i) {
      const Vec3 point = needle.from + (i / num_edges) * needle.along;
      points_.xyz.insert(points_.xyz.end(), point.begin(), point.end());
      points_.size.push_back(size);
    }
  }

  const mesh::CoarseMesh& mesh_;
  const VertexPatches& patches_;
  std::set<LocalIndex> near_{};  // Vertices of sharp tets.
  mesh::SizePoints points_{};
  double num_edges_ = 0.0;
};

}  // namespace

mesh::SizePoints sizes_of_narrow_strips(const mesh::CoarseMesh& mesh, const VertexPatches& patches,
                                        const std::vector<LocalIndex>& sharp,
                                        const StripLimits& limits)
{
  if (sharp.empty() || is_left_out(Repair::narrow_strips)) return {};
  mesh::SizePoints points = StripFinder(mesh, patches, sharp).run(limits);
  note_repair(Repair::narrow_strips, std::ssize(points.size));
  return points;
}

}  // namespace tessera::coarse
