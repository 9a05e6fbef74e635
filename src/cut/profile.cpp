// SPDX-License-Identifier: BSD-3-Clause
#include "cut/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::cut {
namespace {

// How much of a triangle is below an offset, and the integral of that from its lowest point.
struct Below {
  double share = 0.0;
  double integral = 0.0;
};

// For h[0] < offset < h[2], h ascending.
Below below(const std::array<double, 3>& h, double offset)
{
  if (offset <= h[1]) {
    const double d = offset - h[0];
    const double share = d * d / ((h[1] - h[0]) * (h[2] - h[0]));
    return {share, share * d / 3.0};
  }
  const double d = h[2] - offset;
  const double rest = d * d / ((h[2] - h[0]) * (h[2] - h[1]));
  return {1.0 - rest, offset - (h[0] + h[1] + h[2]) / 3.0 + rest * d / 3.0};
}

// What triangles wholly below an entry, but not below the one before, add to it and all later ones.
struct Passed {
  double weight = 0.0;
  double moment = 0.0;
};

}  // namespace

// The divergence theorem: the area of the cut is what flows out below it of a field along the
// normal; the volume is the integral of that area.
Profile profile_of(const PartSurface& part, const Vec3& normal, const std::vector<double>& heights,
                   std::size_t num_entries)
{
  const auto ends = std::ranges::minmax(heights);
  const double low = ends.min;
  const double high = ends.max;
  Profile profile{.first = low, .step = (high - low) / static_cast<double>(num_entries - 1)};
  profile.volume.assign(num_entries, 0.0);
  profile.area.assign(num_entries, 0.0);
  std::vector<Passed> passed(num_entries + 1);
  const auto entry_above = [&](double h) {  // The first one at or above h.
    const double place = profile.step > 0.0 ? std::ceil((h - low) / profile.step) : 0.0;
    return std::min(static_cast<std::size_t>(std::max(place, 0.0)), num_entries);
  };
  part.for_each_triangle([&](LocalIndex i, LocalIndex j, LocalIndex k) {
    std::array h{heights[at(i)], heights[at(j)], heights[at(k)]};
    std::ranges::sort(h);
    const Vec3& p = part.points[at(i)];
    const double weight = -0.5 * dot(normal, cross(part.points[at(j)] - p, part.points[at(k)] - p));
    std::size_t entry = entry_above(h[0]);
    for (; entry < num_entries && profile.offset(entry) < h[2]; ++entry) {
      if (profile.offset(entry) <= h[0]) continue;
      const Below here = below(h, profile.offset(entry));
      profile.area[entry] += weight * here.share;
      profile.volume[entry] += weight * here.integral;
    }
    passed[entry].weight += weight;
    passed[entry].moment += weight * (h[0] + h[1] + h[2]) / 3.0;
  });
  Passed sum;
  for (std::size_t entry = 0; entry < num_entries; ++entry) {
    sum.weight += passed[entry].weight;
    sum.moment += passed[entry].moment;
    profile.area[entry] += sum.weight;
    profile.volume[entry] += sum.weight * profile.offset(entry) - sum.moment;
  }
  return profile;
}

}  // namespace tessera::cut
