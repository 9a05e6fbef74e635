// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "tessera/base/box.hpp"
#include "tessera/mesh/point_field.hpp"
#include "tessera/model/nearest_point.hpp"

namespace tessera::sizing {

/// @brief Sizes between the points of a tet mesh, and around it.
class TetSizes {
 public:
  /// @throws InputError if a used point has no sound position or size, or no tet has a volume.
  TetSizes(const mesh::TetField& field, double grading);

  [[nodiscard]] const tessera::Box& box() const noexcept { return box_; }

  /// @brief As RegionSizes::lower().
  void lower(std::span<const double> xyz, std::span<double> sizes) const;

 private:
  [[nodiscard]] double value_at(const model::NearestPoint& place) const;

  double grading_;
  double least_ = 0.0;    // Of all values.
  mesh::TetField field_;  // Points that tets use, each position once, growth limited.
  tessera::Box box_{};
  std::unique_ptr<const model::TetSearch> search_{};
};

}  // namespace tessera::sizing
