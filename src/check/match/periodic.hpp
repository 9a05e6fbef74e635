// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "check/findings.hpp"
#include "check/piece/mesh.hpp"

namespace tessera::check {

/// @brief Compares patches that the boundary file calls periodic: each point of the one must have a
/// point of the other one where its image is.
class PeriodicMatcher {
 public:
  /// @brief Takes the points of such patches. Local.
  void add(const PieceMesh& boundary, Findings& findings);

  /// @brief Reports points without a partner. @note Collective.
  void finish(const comm::Communicator& comm, Findings& findings);

 private:
  struct SidePoint {
    Vec3 place{};  // Of a point of the one side, its image.
    Vec3 position{};
    GlobalIndex id = kNoId;
    LocalIndex piece = 0;
    LocalIndex point = 0;
    LocalIndex pair = 0;
    std::int64_t slab = 0;
    bool is_image = false;
    bool is_answered = true;  // Or there for another's sake.

    static auto fields(auto& self)
    {
      return std::tie(self.place, self.position, self.id, self.piece, self.point, self.pair,
                      self.slab, self.is_image, self.is_answered);
    }
  };

  void compare(std::vector<SidePoint> points, double tolerance, Findings& findings) const;
  void report(const SidePoint& one, Findings& findings) const;

  std::vector<mesh::PeriodicPair> pairs_{};  // The same in all pieces.
  std::vector<SidePoint> points_{};
};

}  // namespace tessera::check
