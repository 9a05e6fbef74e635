// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/narrow_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/coarse/sharp_tets.hpp"

#include "coarse/narrow_strips.hpp"
#include "coarse/wall_sizes.hpp"

namespace tessera::coarse {
namespace {

// A finer mesh may have so many tets, or so many times those of this one.
constexpr double kFewTets = 3e4;
constexpr double kMostGrowth = 4.0;

// Seven tets of one layer share h^2 of a wall if their edges are h. So a tet becomes about so many
// times the square of its edges over the new ones.
constexpr double kTetsPerSquare = 1.0;

// Points over an edge of a tet. Sizes grow from each, so that half as many as edges will do.
constexpr int kMostPoints = 5;

// Parts of the largest size: far less than in a wall, as a strip needs one row of tets, not a
// sheet.
double least_of_strip(int num_meshes_before) { return std::ldexp(0.002, -2 * num_meshes_before); }

using Corners = std::array<Vec3, 4>;

Corners corners_of(const mesh::CoarseMesh& mesh, LocalIndex t)
{
  const auto v = mesh.tet(t);
  return {mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3])};
}

double longest_edge(const Corners& p)
{
  double longest = 0.0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) longest = std::max(longest, norm(p[b] - p[a]));
  }
  return longest;
}

// The least distance of two parallel planes with the tet between them.
double thickness(const Corners& p)
{
  const double volume = std::abs(6.0 * tet_volume(p[0], p[1], p[2], p[3]));
  double least = std::numeric_limits<double>::infinity();
  const auto between = [&](const Vec3& along, const Vec3& other) {
    const double area = norm(cross(along, other));
    if (area > 0.0) least = std::min(least, volume / area);
  };
  for (std::size_t a = 0; a < 4; ++a) {  // A corner and the side across.
    const Vec3& origin = p[(a + 1) % 4];
    between(p[(a + 2) % 4] - origin, p[(a + 3) % 4] - origin);
  }
  between(p[1] - p[0], p[3] - p[2]);  // Edges across from each other.
  between(p[2] - p[0], p[3] - p[1]);
  between(p[3] - p[0], p[2] - p[1]);
  return least;
}

class WallFinder {
 public:
  WallFinder(const mesh::CoarseMesh& mesh, const VertexPatches& patches, double max_size,
             double least_size)
      : mesh_(mesh), patches_(patches), max_size_(max_size), least_size_(least_size)
  {
  }

  // All corners are on the surface, and not all on one patch of it.
  [[nodiscard]] bool is_in_wall(LocalIndex t) const
  {
    const auto v = mesh_.tet(t);
    if (std::ranges::any_of(v, [&](LocalIndex i) { return patches_[at(i)].empty(); })) return false;
    return std::ranges::none_of(patches_[at(v[0])], [&](LocalIndex patch) {
      return std::ranges::all_of(v, [&](LocalIndex i) { return patches_[at(i)].contains(patch); });
    });
  }

  // Of a tet in a wall.
  void add(LocalIndex t)
  {
    const Corners p = corners_of(mesh_, t);
    const double size = std::clamp(kEdgesOfWall * thickness(p), least_size_, max_size_);
    const double edges = longest_edge(p) / size;
    if (edges <= 1.0 || is_left_out(Repair::thin_walls)) return;  // It is flat for another reason.
    ++num_walls_;
    num_tets_ += kTetsPerSquare * edges * edges;
    add_points(p, size, std::clamp(static_cast<int>(std::ceil(0.5 * edges)), 1, kMostPoints));
  }

  // Beside a first mesh of so many tets.
  [[nodiscard]] bool is_out_of_proportion(LocalIndex num_first) const
  {
    const double more = num_tets_ + (mesh_.num_tets() - num_first);
    return more > std::max(kFewTets, kMostGrowth * num_first);
  }

  mesh::SizePoints take()
  {
    note_repair(Repair::thin_walls, num_walls_);
    return std::move(points_);
  }

 private:
  void add_points(const Corners& p, double size, int n)
  {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        for (int k = 0; i + j + k <= n; ++k) {
          const std::array<int, 4> parts{i, j, k, n - i - j - k};
          Vec3 point{};
          for (std::size_t c = 0; c < 4; ++c) point = point + (1.0 * parts[c] / n) * p[c];
          points_.xyz.insert(points_.xyz.end(), point.begin(), point.end());
          points_.size.push_back(size);
        }
      }
    }
  }

  const mesh::CoarseMesh& mesh_;
  const VertexPatches& patches_;
  double max_size_;
  double least_size_;
  mesh::SizePoints points_{};
  GlobalIndex num_walls_ = 0;  // Tets.
  double num_tets_ = 0.0;
};

VertexPatches patches_of_vertices(const mesh::CoarseMesh& mesh)
{
  VertexPatches patches(at(mesh.num_vertices()));
  for (std::size_t i = 0; i < mesh.face_vertices.size(); ++i) {
    patches[at(mesh.face_vertices[i])].insert(mesh.face_patch[i / 3]);
  }
  return patches;
}

}  // namespace

mesh::SizePoints sizes_of_narrow_places(const mesh::CoarseMesh& mesh, double angle_deg,
                                        double max_size, const FinerBefore& before)
{
  const SharpTets sharp = find_sharp_tets(mesh, angle_deg);
  if (sharp.others.empty()) return {};
  const VertexPatches patches = patches_of_vertices(mesh);
  const double least_of_wall = std::ldexp(kLeastOfWall, -before.num_meshes);
  WallFinder walls(mesh, patches, max_size, least_of_wall * max_size);
  std::vector<LocalIndex> others;
  for (const LocalIndex t : sharp.others) {
    if (walls.is_in_wall(t)) {
      walls.add(t);
    } else {
      others.push_back(t);
    }
  }
  const LocalIndex num_first = before.num_meshes == 0 ? mesh.num_tets() : before.num_first_tets;
  if (walls.is_out_of_proportion(num_first)) {
    return {};  // They stay the worst, whatever strips gain.
  }
  mesh::SizePoints points = walls.take();
  const StripLimits limits{.least_size = least_of_strip(before.num_meshes) * max_size,
                           .num_first_tets = num_first};
  const mesh::SizePoints strips = sizes_of_narrow_strips(mesh, patches, others, limits);
  points.xyz.insert(points.xyz.end(), strips.xyz.begin(), strips.xyz.end());
  points.size.insert(points.size.end(), strips.size.begin(), strips.size.end());
  return points;
}

}  // namespace tessera::coarse
