// SPDX-License-Identifier: BSD-3-Clause
#include "cut/judge_plane.hpp"

#include "cut/landmarks.hpp"
#include "cut/moments.hpp"
#include "cut/section.hpp"

namespace tessera::cut {

PlaneJudgement judge_plane(const PartSurface& part, const Plane& plane, double coarse_size)
{
  const std::vector<double> heights = part.heights(plane);
  const Section section = section_of(part, plane, heights, coarse_size);
  const double volume = volume_of(part);
  const double below = volume_below(part, plane.normal, heights);
  return {.fraction_below = volume > 0.0 ? below / volume : 0.0,
          .area = section.area,
          .clearance = clearance_of(LandmarkFinder(part, coarse_size).find(heights), 0.0,
                                    coarse_size, kLargestClearance),
          .shortest_edge = section.shortest_edge / coarse_size,
          .angle_deg = section.angle_deg};
}

}  // namespace tessera::cut
