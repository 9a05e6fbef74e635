// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/comm/find_partners.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "check/findings.hpp"
#include "check/piece/mesh.hpp"

namespace tessera::check {

/// @brief Compares patches that the boundary file calls periodic: each point of the one must have a
/// point of the other one where its image is; and what the file says of partners must be true.
class PeriodicMatcher {
 public:
  /// @brief Takes the points of such patches. Local.
  void add(const PieceMesh& boundary, Findings& findings);

  /// @brief Reports points without a partner, or with a wrong one. @note Collective.
  void finish(const comm::Communicator& comm, Findings& findings);

 private:
  struct Point {
    Vec3 position{};
    GlobalIndex id = kNoId;
    LocalIndex piece = 0;
    LocalIndex point = 0;
    LocalIndex pair = 0;                           // A row of pairs_ with the patch.
    std::optional<GlobalIndex> partner_of_file{};  // What the file says of an image.
  };

  struct Side {
    LocalIndex pair = 0;
    LocalIndex transform = 0;
    bool is_image = false;
  };

  void add_point(const PieceMesh& boundary, LocalIndex point, const Side& side);
  void report(const Point& one, bool is_image, Findings& findings) const;

  std::vector<mesh::PeriodicPair> pairs_{};  // The same in all pieces.
  std::vector<comm::SidePoint> places_{};    // Groups: mesh::transforms_of().
  std::vector<Point> points_{};              // Whose places these are.
};

}  // namespace tessera::check
