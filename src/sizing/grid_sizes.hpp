// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/base/box.hpp"
#include "tessera/mesh/point_field.hpp"

namespace tessera::sizing {

/// @brief Sizes between the points of a regular grid, and around it.
class GridSizes {
 public:
  /// @throws InputError if a point has no sound position or size.
  GridSizes(const mesh::GridField& field, double grading);

  [[nodiscard]] const tessera::Box& box() const noexcept { return box_; }

  /// @brief As RegionSizes::lower().
  void lower(std::span<const double> xyz, std::span<double> sizes) const;

 private:
  [[nodiscard]] double size_at(const Vec3& point) const;

  double grading_;
  mesh::GridField field_;  // Growth limited.
  Vec3 step_lengths_{};
  tessera::Box box_{};
};

}  // namespace tessera::sizing
