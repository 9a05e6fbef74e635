// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/model/model.hpp"

#include "support/flat_model.hpp"

namespace tessera::testing {

/// @brief Spheres around the origin, one a surface; no parameters, no curves. Goes with ball() and
/// shell().
class SphereModel final : public model::Model {
 public:
  explicit SphereModel(std::vector<double> radii) : radii_(std::move(radii)) {}

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;
  [[nodiscard]] double box_diagonal() const override;

 private:
  std::vector<double> radii_;
};

/// @brief The cylinder x^2 + y^2 = 1, 0 <= z <= 1, as OpenCASCADE would give it: the mantle
/// (surface 0) has parameters (angle, z) with a period, the bottom (1) and the top (2) have (x, y),
/// the lower (curve 0) and the upper rim (1) the angle.
///
/// The returned angle is of the branch next to the guess; a guess more than a quarter turn off is a
/// GeometryError: whoever averages angles over a seam gets it. Goes with cylinder().
class CylinderModel final : public model::Model {
 public:
  [[nodiscard]] bool has_parameters() const override { return true; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;
  [[nodiscard]] double box_diagonal() const override;
};

/// @brief A brick whose bottom (surface 4, patch z0 of kuhn_cube()) is the graph z = height(x, y);
/// everything else is where the coarse mesh is. A height above the inner vertices folds the mesh.
class GraphModel final : public model::Model {
 public:
  using Height = std::function<double(double x, double y)>;

  explicit GraphModel(Height height) : height_(std::move(height)) {}

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters&) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3& point,
                                                   double) const override;
  [[nodiscard]] double box_diagonal() const override;

 private:
  Height height_;
};

/// @brief Another model whose projection stops when `share` of the way is done: an error that a
/// second projection shows.
class LazyModel final : public model::Model {
 public:
  /// @param[in] exact Borrowed; must outlive this. @param[in] share In [0, 1].
  LazyModel(const model::Model& exact, double share) : exact_(exact), share_(share) {}

  [[nodiscard]] bool has_parameters() const override { return exact_.has_parameters(); }
  [[nodiscard]] double surface_tolerance(LocalIndex s) const override
  {
    return exact_.surface_tolerance(s);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex c) const override
  {
    return exact_.curve_tolerance(c);
  }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;
  [[nodiscard]] double box_diagonal() const override { return exact_.box_diagonal(); }

 private:
  const model::Model& exact_;
  double share_;
};

}  // namespace tessera::testing
