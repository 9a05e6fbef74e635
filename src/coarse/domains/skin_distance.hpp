// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::coarse {

/// @brief How deep inside of a closed surface a point lies. Local.
class SkinDistance {
 public:
  explicit SkinDistance(const surface::DomainSkin& skin);

  /// @brief Whether the point lies inside, and is at least as far from the surface. It may err
  /// where the surface cuts itself. @pre least > 0.
  [[nodiscard]] bool is_inside(const Vec3& point, double least) const
  {
    return find(point, least).side < 0;
  }
  /// @brief The same of the outside.
  [[nodiscard]] bool is_outside(const Vec3& point, double least) const
  {
    return find(point, least).side > 0;
  }

  /// @brief On which side a point lies.
  struct Place {
    int side = 0;           ///< -1 inside, 1 outside, 0 nearer to the surface than was asked.
    double distance = 0.0;  ///< From the surface.
  };
  [[nodiscard]] Place find(const Vec3& point, double least) const;

  /// @brief Corners of the surface's triangles, in their order.
  [[nodiscard]] const std::vector<std::array<Vec3, 3>>& triangles() const { return triangles_; }

 private:
  [[nodiscard]] Vec3 normal_at(const model::NearestPoint& nearest) const;
  [[nodiscard]] bool is_wound_around(const Vec3& point) const;

  const surface::DomainSkin& skin_;
  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Vec3> vertex_normals_;  // Of the triangles around, weighted by their angles there.
  mesh::NumberedRows<2> edges_;       // Of the sides of the triangles, three each.
  std::vector<Vec3> edge_normals_;    // Of the triangles beside each.
  model::TriangleSearch search_;
};

/// @brief Tells of many points, one near the other, which lie inside. Local.
///
/// No surface comes nearer to a point than it is deep. So most points beside a deep one are inside
/// without a search.
class InsideFinder {
 public:
  /// @param[in] distance Must live on.
  explicit InsideFinder(const SkinDistance& distance) : distance_(distance) {}

  /// @brief As SkinDistance::is_inside().
  [[nodiscard]] bool is_inside(const Vec3& point, double least);

 private:
  const SkinDistance& distance_;
  Vec3 last_{};  // The last point that was searched, and where it is.
  SkinDistance::Place place_{};
};

}  // namespace tessera::coarse
