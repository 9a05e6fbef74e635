// SPDX-License-Identifier: BSD-3-Clause
#include "layers/link_way.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::layers {
namespace {

// What a way costs for each radian that it goes round the vertex, beside the radians that it is off
// the plane: of two ways that are as good, the shorter one is taken.
constexpr double kCostOfWay = 0.1;

}  // namespace

LinkOf::LinkOf(const mesh::CoarseMesh& mesh, std::span<const LocalIndex> tets, LocalIndex vertex)
    : mesh_(mesh), here_(mesh.position(vertex))
{
  for (const LocalIndex tet : tets) {
    for (const LocalIndex a : mesh.tet(tet)) {
      for (const LocalIndex b : mesh.tet(tet)) {
        if (a != b && a != vertex && b != vertex) beside_[a].insert(b);
      }
    }
  }
}

double LinkOf::cost(LocalIndex a, LocalIndex b, const Vec3& normal) const
{
  const Vec3 to_a = mesh_.position(a) - here_;
  const Vec3 to_b = mesh_.position(b) - here_;
  const auto off = [&](const Vec3& to) {
    return std::abs(std::asin(std::clamp(dot(unit(to), normal), -1.0, 1.0)));
  };
  return angle_between(to_a, to_b) * (kCostOfWay + off(to_a) + off(to_b));
}

std::vector<LocalIndex> LinkOf::way(LocalIndex first, const std::set<LocalIndex>& ends,
                                    std::span<const char> is_blocked, const Vec3& normal) const
{
  std::map<LocalIndex, std::pair<double, LocalIndex>> known{{first, {0.0, kNoIndex}}};
  std::set<std::pair<double, LocalIndex>> to_visit{{0.0, first}};
  while (!to_visit.empty()) {
    const auto [so_far, here] = *to_visit.begin();
    to_visit.erase(to_visit.begin());
    if (ends.contains(here)) {
      std::vector<LocalIndex> way;
      for (LocalIndex v = here; v != kNoIndex; v = known.at(v).second) way.push_back(v);
      std::ranges::reverse(way);
      return way;
    }
    for (const LocalIndex next : beside_.at(here)) {
      if (is_blocked[at(next)] != 0 && !ends.contains(next)) continue;
      const double total = so_far + cost(here, next, normal);
      const auto found = known.find(next);
      if (found != known.end() && found->second.first <= total) continue;
      known[next] = {total, here};
      to_visit.emplace(total, next);
    }
  }
  return {};
}

}  // namespace tessera::layers
