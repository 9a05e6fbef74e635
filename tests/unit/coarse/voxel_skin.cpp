// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_skin.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "tessera/base/vec3.hpp"

namespace tessera::testing {
namespace {

using Place = std::array<int, 3>;

class Maker {
 public:
  explicit Maker(double side) : side_(side) {}

  void add_square(const Place& cell, std::size_t axis, bool is_high)
  {
    const auto corner = [&](int u, int v) {
      Place place = cell;
      place[axis] += is_high ? 1 : 0;
      place[(axis + 1) % 3] += u;
      place[(axis + 2) % 3] += v;
      return vertex_at(place);
    };
    const LocalIndex a = corner(0, 0);
    LocalIndex b = corner(1, 0);
    const LocalIndex c = corner(1, 1);
    LocalIndex d = corner(0, 1);
    if (!is_high) std::swap(b, d);
    skin_.triangle_vertices.insert(skin_.triangle_vertices.end(), {a, b, d, b, c, d});
    const auto patch = static_cast<LocalIndex>(2 * axis) + (is_high ? 1 : 0);
    skin_.triangle_patch.insert(skin_.triangle_patch.end(), {patch, patch});
  }

  surface::DomainSkin take(int n)
  {
    skin_.vertex.resize(skin_.vertex_xyz.size() / 3);
    std::iota(skin_.vertex.begin(), skin_.vertex.end(), 0);
    skin_.max_size = std::sqrt(2.0) * side_;
    skin_.model_box = {Vec3{0, 0, 0}, Vec3{n * side_, n * side_, n * side_}};
    return std::move(skin_);
  }

 private:
  LocalIndex vertex_at(const Place& place)
  {
    const auto next = static_cast<LocalIndex>(row_.size());
    const auto [entry, is_new] = row_.try_emplace(place, next);
    if (is_new) {
      for (const int c : place) skin_.vertex_xyz.push_back(side_ * c);
    }
    return entry->second;
  }

  double side_;
  std::map<Place, LocalIndex> row_{};
  surface::DomainSkin skin_{};
};

}  // namespace

surface::DomainSkin voxel_skin(int n, double side,
                               const std::function<bool(const Place& cell)>& is_inside)
{
  const auto has = [&](const Place& cell) {
    return std::ranges::all_of(cell, [&](int c) { return c >= 0 && c < n; }) && is_inside(cell);
  };
  Maker maker(side);
  for (int i = 0; i < n * n * n; ++i) {
    const Place cell{i / (n * n), i / n % n, i % n};
    if (!has(cell)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool is_high : {false, true}) {
        Place beside = cell;
        beside[axis] += is_high ? 1 : -1;
        if (!has(beside)) maker.add_square(cell, axis, is_high);
      }
    }
  }
  return maker.take(n);
}

surface::DomainSkin cube_skin(int n, double side)
{
  return voxel_skin(n, side, [](const Place& /*cell*/) { return true; });
}

surface::DomainSkin l_shape_skin(int n, double side)
{
  return voxel_skin(n, side, [n](const Place& cell) { return 2 * std::min(cell[0], cell[1]) < n; });
}

surface::DomainSkin ball_skin(int n)
{
  surface::DomainSkin skin = cube_skin(n, 2.0 / n);
  for (std::size_t i = 0; i < skin.vertex_xyz.size(); i += 3) {
    const Vec3 p = unit(point_at(std::span<const double>(skin.vertex_xyz), i / 3) - Vec3{1, 1, 1});
    std::ranges::copy(p, &skin.vertex_xyz[i]);
  }
  skin.model_box = {Vec3{-1, -1, -1}, Vec3{1, 1, 1}};
  return skin;
}

}  // namespace tessera::testing
