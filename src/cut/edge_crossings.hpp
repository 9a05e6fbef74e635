// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// Where a plane crosses the edges of a part: the same point for all that have the edge.
class EdgeCrossings {
 public:
  /// @param[in] heights Of the part's points above the plane. Both must outlive this.
  EdgeCrossings(const PartSurface& part, const std::vector<double>& heights)
      : part_(part), heights_(heights)
  {
  }

  [[nodiscard]] bool is_below(LocalIndex v) const { return heights_[at(v)] < 0.0; }

  /// @brief Row of the crossing in `points`, which gets it if it is new. @pre The plane is between
  /// a and b, and all calls give the same points.
  LocalIndex row(LocalIndex a, LocalIndex b, std::vector<Vec3>& points)
  {
    if (b < a) std::swap(a, b);
    const auto key = (static_cast<std::uint64_t>(a) << 32U) | static_cast<std::uint64_t>(b);
    const auto [place, is_new] = rows_.try_emplace(key, static_cast<LocalIndex>(points.size()));
    if (is_new) {
      const double share = heights_[at(a)] / (heights_[at(a)] - heights_[at(b)]);
      points.push_back(part_.points[at(a)] + share * (part_.points[at(b)] - part_.points[at(a)]));
    }
    return place->second;
  }

 private:
  const PartSurface& part_;
  const std::vector<double>& heights_;
  std::unordered_map<std::uint64_t, LocalIndex> rows_{};  // By edge; only looked up.
};

}  // namespace tessera::cut
