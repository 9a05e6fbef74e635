// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/comm/find_partners.hpp"
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
  struct Point {
    Vec3 position{};
    GlobalIndex id = kNoId;
    LocalIndex piece = 0;
    LocalIndex point = 0;
  };

  [[nodiscard]] LocalIndex group_of(LocalIndex pair) const;
  void report(const Point& one, const comm::SidePoint& place, Findings& findings) const;

  std::vector<mesh::PeriodicPair> pairs_{};  // The same in all pieces.
  std::vector<comm::SidePoint> places_{};    // Group: the first pair with the transform.
  std::vector<Point> points_{};              // Whose places these are.
};

}  // namespace tessera::check
