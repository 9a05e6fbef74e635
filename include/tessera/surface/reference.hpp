// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tessera/model/model.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief A triangulated surface as that which another one has to follow: nearest points, normals
/// and parameters, patch by patch and curve by curve. Pure functions all.
class SurfaceReference {
 public:
  /// @brief A point of a patch.
  struct Place {
    Vec3 xyz{};
    Vec3 normal{};  ///< Of length 1.
  };

  /// @pre validate() accepts the surface.
  explicit SurfaceReference(PatchSurface surface);

  [[nodiscard]] const PatchSurface& surface() const { return surface_; }
  [[nodiscard]] Vec3 on_patch(LocalIndex patch, const Vec3& point) const;
  /// @brief The same with the normal there.
  [[nodiscard]] Place place_on_patch(LocalIndex patch, const Vec3& point) const;
  [[nodiscard]] Vec3 on_curve(LocalIndex curve, const Vec3& point) const;
  /// @brief Unit normal of the patch's triangle that is nearest to the point.
  [[nodiscard]] Vec3 normal(LocalIndex patch, const Vec3& point) const;
  /// @brief The one normal of a patch that is flat; null if it is not.
  [[nodiscard]] const Vec3* normal_of_plane(LocalIndex patch) const;
  /// @brief Parameters of the patch's surface near the point; 0 if there are none.
  [[nodiscard]] model::SurfaceParameters parameters(LocalIndex patch, const Vec3& point) const;
  /// @brief Parameter of the curve near the point; 0 if there is none.
  [[nodiscard]] double curve_parameter(LocalIndex curve, const Vec3& point) const;

 private:
  // The triangles of one patch that have an area.
  struct Patch {
    std::vector<LocalIndex> triangles{};
    model::TriangleSearch search;
    bool is_flat = false;  // Then all have one normal, to rounding.
  };

  struct Curve {
    std::vector<std::size_t> edges{};
    std::optional<model::SegmentSearch> search{};  // Of a number without edges there is none.
  };

  void add_curves();
  void add_patch(const std::vector<LocalIndex>& triangles);
  [[nodiscard]] std::size_t nearest_triangle(LocalIndex patch, const Vec3& point) const;

  PatchSurface surface_;
  std::vector<Vec3> normals_{};  // Of the triangles.
  std::vector<Patch> patches_{};
  std::vector<Curve> curves_{};
};

}  // namespace tessera::surface
