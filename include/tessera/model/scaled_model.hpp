// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/model.hpp"

namespace tessera::model {

/// @brief A model in output length units, made from one in file length units.
class ScaledModel final : public Model {
 public:
  /// @param[in] file_model Borrowed; must outlive this. @param[in] scale Output units per file
  /// unit, > 0.
  ScaledModel(const Model& file_model, double scale) : file_model_(file_model), scale_(scale) {}

  [[nodiscard]] bool has_parameters() const override { return file_model_.has_parameters(); }

  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override
  {
    return scale_ * file_model_.surface_tolerance(surface);
  }

  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return scale_ * file_model_.curve_tolerance(curve);
  }

  [[nodiscard]] double end_tolerance(LocalIndex curve, const Vec3& point) const override
  {
    return scale_ * file_model_.end_tolerance(curve, (1.0 / scale_) * point);
  }

  [[nodiscard]] SurfacePoint project_to_surface(LocalIndex surface, const Vec3& point,
                                                const SurfaceParameters& guess) const override
  {
    const SurfacePoint found =
        file_model_.project_to_surface(surface, (1.0 / scale_) * point, guess);
    return {scale_ * found.xyz, found.uv};
  }

  [[nodiscard]] CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                            double guess) const override
  {
    const CurvePoint found = file_model_.project_to_curve(curve, (1.0 / scale_) * point, guess);
    return {scale_ * found.xyz, found.t};
  }

  [[nodiscard]] double box_diagonal() const override { return scale_ * file_model_.box_diagonal(); }

 private:
  const Model& file_model_;
  double scale_;
};

}  // namespace tessera::model
