// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tessera/base/box_tree.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief A triangle, and where its corners are.
struct PlacedTriangle {
  PatchSurface::Triangle vertices{};
  std::array<Vec3, 3> corners{};
  /// The patch, if the triangle is known to look its way. Two such triangles of one patch lie
  /// beside each other round a corner that they share, so they are not tested. That is wrong only
  /// where a patch comes to a vertex twice; find_overlaps() sees those.
  LocalIndex patch = kNoIndex;
};

/// @brief Whether an edge that meets an edge or a corner of a triangle goes through it.
enum class AtRim { goes_through, passes };

/// @brief Where an edge of one triangle goes through the other; nothing if none does, or if they
/// share an edge. Local.
[[nodiscard]] std::optional<Vec3> crossing(const PlacedTriangle& a, const PlacedTriangle& b,
                                           AtRim at_rim = AtRim::goes_through);

/// @brief A box that holds every point.
inline constexpr Box kEverywhere{-1.0 * kNoPoint, kNoPoint};

/// @brief The triangles of a surface as it changes, to tell which changes would make it cut itself.
/// Local.
class CrossingGuard {
 public:
  /// @param[in] guarded Where changes are looked at.
  explicit CrossingGuard(const PatchSurface& surface, std::vector<Box> guarded = {kEverywhere},
                         AtRim at_rim = AtRim::goes_through);

  /// @brief Whether changes are looked at that reach a box.
  [[nodiscard]] bool is_at(const Box& box) const;

  /// @brief Whether `made` in the place of `old` cut other triangles and each other at no more
  /// pairs than those do, or are where nothing is guarded. So a surface that cuts itself already
  /// may still change there.
  [[nodiscard]] bool allows(std::span<const LocalIndex> old, std::span<const PlacedTriangle> made);

  /// @brief Triangle `t` is another one now.
  void change(LocalIndex t, const PlacedTriangle& triangle);
  /// @brief The surface got the next triangle, near triangle `beside`.
  void add(const PlacedTriangle& triangle, LocalIndex beside);
  void remove(LocalIndex t);

  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangles_.size());
  }

 private:
  struct Near {
    Box box{};
    Vec3 normal{};
    LocalIndex triangle = kNoIndex;
  };

  void find_near(const Box& box, std::span<const LocalIndex> without);
  [[nodiscard]] int count_near(std::span<const PlacedTriangle> some) const;

  std::vector<PlacedTriangle> triangles_{};
  BoxTree tree_;
  BoxTree guarded_;
  AtRim at_rim_;
  std::vector<Near> near_{};  // Of one question; kept for its memory.
};

}  // namespace tessera::surface
