// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <set>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/coarse/fit_to_cad.hpp"

namespace tessera::coarse {

/// @brief A point on a part of a CAD model, and how far it is from what was asked.
struct CadPlace {
  Vec3 xyz{};
  double distance = 0.0;
};

/// @brief What lies near a point of a CAD model: by its triangles first, then on the model itself.
class CadSearch {
 public:
  /// All are borrowed.
  CadSearch(const CadSurface& cad, const surface::SurfaceReference& reference,
            const model::Model& model);

  /// @brief The patches that have a place within `tolerance` of the point, ascending. @note Local.
  [[nodiscard]] std::vector<LocalIndex> patches_near(const Vec3& point, double tolerance) const;
  /// @brief The nearest patch and its place there, by the triangles alone.
  [[nodiscard]] std::pair<LocalIndex, CadPlace> nearest_patch(const Vec3& point) const;
  /// @brief Infinitely far if the model finds none.
  [[nodiscard]] CadPlace on_patch(LocalIndex patch, const Vec3& point) const;
  [[nodiscard]] CadPlace on_curve(LocalIndex curve, const Vec3& point) const;
  /// @brief How little a triangle looks like the patch: mean distance of inner points, in longest
  /// edges, and a penalty for another normal.
  [[nodiscard]] double misfit(LocalIndex patch, const std::array<Vec3, 3>& triangle) const;
  /// @brief Unit normal of the patch near the point.
  [[nodiscard]] Vec3 normal(LocalIndex patch, const Vec3& point) const
  {
    return reference_.normal(patch, point);
  }
  /// @brief The curves with both patches beside them, ascending.
  [[nodiscard]] std::vector<LocalIndex> curves_between(LocalIndex a, LocalIndex b) const;
  /// @brief The nearest place where curves end or meet; infinitely far if there is none.
  [[nodiscard]] CadPlace nearest_corner(const Vec3& point) const;

 private:
  void find_boxes();
  void find_patches_of_curves();
  void find_corners();
  template <class Project>
  [[nodiscard]] CadPlace found(const Vec3& point, const Project& project) const;

  const CadSurface& cad_;
  const surface::SurfaceReference& reference_;
  const model::Model& model_;
  std::vector<Box> boxes_{};  // Of the patches' triangles.
  std::vector<std::set<LocalIndex>> patches_of_curve_{};
  std::vector<Vec3> corners_{};
  mutable Attempts projections_{"places on the CAD model"};
};

}  // namespace tessera::coarse
