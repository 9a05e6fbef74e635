// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/touching_faces.hpp"

#include <algorithm>

#include "tessera/base/box.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/model/nearest_point.hpp"

namespace tessera::surface {
namespace {

using Triangle = std::array<LocalIndex, 3>;

// Along an axis all triangles of a flat side would be met at once.
constexpr Vec3 kSweep{0.8, 0.5, 0.33};

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

class TouchSearch {
 public:
  TouchSearch(std::span<const double> xyz, const std::vector<Triangle>& triangles, double tolerance)
      : triangles_(triangles), tolerance_(tolerance)
  {
    for (const Triangle& t : triangles) {
      corners_.push_back({point_at(xyz, t[0]), point_at(xyz, t[1]), point_at(xyz, t[2])});
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = corners_[t];
      boxes_.push_back(box_of(corners_[t]));
      const std::array<double, 3> along{dot(kSweep, a), dot(kSweep, b), dot(kSweep, c)};
      const auto [low, high] = std::ranges::minmax(along);
      sweep_.push_back({low, high});
      order_.push_back(t);
    }
    std::ranges::sort(order_, {}, [this](std::size_t t) { return sweep_[t].low; });
  }

  // Sweeps a plane; only triangles that it cuts at the same time can touch.
  std::optional<TouchingFaces> run() const
  {
    std::vector<std::size_t> open;
    for (const std::size_t t : order_) {
      const double front = sweep_[t].low - tolerance_;
      std::erase_if(open, [&](std::size_t o) { return sweep_[o].high < front; });
      for (const std::size_t o : open) {
        if (!are_boxes_near(o, t)) continue;
        if (const auto place = touch(o, t)) return TouchingFaces{o, t, *place};
        if (const auto place = touch(t, o)) return TouchingFaces{t, o, *place};
      }
      open.push_back(t);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool are_boxes_near(std::size_t a, std::size_t b) const
  {
    const Box& of_a = boxes_[a];
    const Box& of_b = boxes_[b];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (of_a.low[axis] > of_b.high[axis] + tolerance_) return false;
      if (of_b.low[axis] > of_a.high[axis] + tolerance_) return false;
    }
    return true;
  }

  // A point of `a`, which `b` does not have as a corner, that lies on `b`.
  [[nodiscard]] std::optional<Vec3> touch(std::size_t a, std::size_t b) const
  {
    const Vec3 middle = middle_of(corners_[a]);
    if (is_on(middle, b)) return middle;
    for (std::size_t c = 0; c < 3; ++c) {
      const bool is_shared =
          std::ranges::find(triangles_[b], triangles_[a][c]) != triangles_[b].end();
      if (!is_shared && is_on(corners_[a][c], b)) return corners_[a][c];
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_on(const Vec3& point, std::size_t t) const
  {
    return norm(model::nearest_point_of(corners_[t], point) - point) <= tolerance_;
  }

  const std::vector<Triangle>& triangles_;
  double tolerance_;
  std::vector<std::array<Vec3, 3>> corners_{};
  std::vector<Box> boxes_{};
  std::vector<Interval> sweep_{};
  std::vector<std::size_t> order_{};  // By where the sweep meets them.
};

}  // namespace

std::optional<TouchingFaces> find_touching_faces(
    std::span<const double> vertex_xyz, const std::vector<std::array<LocalIndex, 3>>& triangles,
    double tolerance)
{
  return TouchSearch(vertex_xyz, triangles, tolerance).run();
}

}  // namespace tessera::surface
