// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief A point of one of two sides, which looks for one of the other side where it is itself.
struct SidePoint {
  Vec3 place{};            ///< Of a point that has an image, that of the image.
  GlobalIndex label = 0;   ///< What its partner is told; not negative.
  std::int32_t group = 0;  ///< Partners are of one group.
  bool is_image = false;   ///< Of which side it is.

  static auto fields(auto& self)
  {
    return std::tie(self.place, self.label, self.group, self.is_image);
  }
};
inline constexpr GlobalIndex kNoPartner = -1;

/// @brief The partner of each point: the nearest one of its group on the other side, if its
/// distance is no more than 1e-9 of the largest coordinate; of several the one of the least label.
/// Images differ by rounding, also where several transforms lead there.
/// @note Collective. The same for any distribution of the points.
/// @return Shape (points.size()): labels; kNoPartner where there is none.
[[nodiscard]] std::vector<GlobalIndex> find_partners(std::span<const SidePoint> points,
                                                     const Communicator& comm);

}  // namespace tessera::comm
