// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// One side of a plane that made a cap.
struct HalfSpace {
  Plane plane{};
  LocalIndex label = kNoIndex;  ///< Of the cap.
  bool is_upper = false;
};

/// Lines that planes draw on caps, and on faces between solids. The mesh of such a border has the
/// lines of both sides, so each side must keep clear of those of the other one.
class ForeignLines {
 public:
  /// @brief Keeps the lines of a cut. @param node Of the plane.
  void keep(const std::vector<Trace>& traces, LocalIndex node);

  /// @brief The part with the lines of others on its borders, as edges.
  /// @param cell Half-spaces that the part is in: lines end there. @param size Of the edges.
  [[nodiscard]] PartSurface with_lines(const PartSurface& part, LocalIndex solid,
                                       const std::vector<HalfSpace>& cell, double size) const;

 private:
  struct Line {
    std::array<Vec3, 2> ends{};
    LocalIndex face = kNoIndex;
    LocalIndex node = kNoIndex;
  };

  std::map<std::array<LocalIndex, 2>, std::vector<Line>> of_caps_{};  // By label and who sees them.
  std::map<LocalIndex, std::vector<Line>> of_faces_{};                // By who sees them.
};

}  // namespace tessera::cut
