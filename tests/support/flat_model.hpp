// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "tessera/model/model.hpp"

namespace tessera::testing {

/// @brief Every surface and curve is where the coarse mesh is: projection changes nothing.
class FlatModel : public model::Model {
 public:
  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex, const Vec3& point, const model::SurfaceParameters&) const override
  {
    return {point, {}};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3& point,
                                                   double) const override
  {
    return {point, 0.0};
  }
  [[nodiscard]] double box_diagonal() const override { return std::sqrt(3.0); }
};

}  // namespace tessera::testing
