// SPDX-License-Identifier: BSD-3-Clause
#include "cut/foreign_lines.hpp"

#include <utility>

namespace tessera::cut {
namespace {

// Whether something is left of the line between two points, which become those of the rest.
bool clip(std::array<Vec3, 2>& ends, const HalfSpace& half)
{
  const double sign = half.is_upper ? 1.0 : -1.0;
  const std::array height{sign * half.plane.height(ends[0]), sign * half.plane.height(ends[1])};
  if (height[0] <= 0.0 && height[1] <= 0.0) return false;
  for (std::size_t end = 0; end < 2; ++end) {
    if (height[end] >= 0.0) continue;
    const double share = height[end] / (height[end] - height[1 - end]);
    ends[end] = ends[end] + share * (ends[1 - end] - ends[end]);
  }
  return true;
}

// Adds lines to a part; those of a plane that follow each other share a point.
class Adder {
 public:
  Adder(PartSurface& part, const std::vector<HalfSpace>& cell, double size)
      : part_(part), cell_(cell), size_(size)
  {
  }

  void add(std::array<Vec3, 2> ends, LocalIndex face, LocalIndex node)
  {
    for (const HalfSpace& half : cell_) {
      // A line on a cap is on its plane.
      if (half.label != face && !clip(ends, half)) return;
    }
    const LocalIndex a = point(ends[0], node);
    const LocalIndex b = point(ends[1], node);
    if (a != b) part_.edges.push_back({{a, b}, {face, face}, size_, node});
  }

 private:
  LocalIndex point(const Vec3& p, LocalIndex node)
  {
    const auto [place, is_new] =
        points_.try_emplace({p, node}, static_cast<LocalIndex>(part_.points.size()));
    if (is_new) part_.points.push_back(p);
    return place->second;
  }

  PartSurface& part_;
  const std::vector<HalfSpace>& cell_;
  double size_;
  std::map<std::pair<Vec3, LocalIndex>, LocalIndex> points_{};
};

}  // namespace

void ForeignLines::keep(const std::vector<Trace>& traces, LocalIndex node)
{
  for (const Trace& trace : traces) {
    const Line line{trace.ends, trace.face, node};
    if (trace.neighbour == kNoIndex) {
      of_caps_[{trace.face, trace.is_upper ? 0 : 1}].push_back(line);
    } else {
      of_faces_[trace.neighbour].push_back(line);
    }
  }
}

PartSurface ForeignLines::with_lines(const PartSurface& part, LocalIndex solid,
                                     const std::vector<HalfSpace>& cell, double size) const
{
  PartSurface result = part;
  Adder adder(result, cell, size);
  const auto add_all = [&](const auto& lines_by_key, const auto& key) {
    const auto place = lines_by_key.find(key);
    if (place == lines_by_key.end()) return;
    for (const Line& line : place->second) adder.add(line.ends, line.face, line.node);
  };
  for (const Cap& cap : part.caps) {
    add_all(of_caps_, std::array<LocalIndex, 2>{cap.label, cap.is_upper ? 1 : 0});
  }
  add_all(of_faces_, solid);
  return result;
}

}  // namespace tessera::cut
