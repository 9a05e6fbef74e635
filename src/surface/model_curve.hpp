// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/model.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::surface {

/// @brief A point put onto a curve of the model; the triangles say where on it to begin. Local.
/// @throws GeometryError if the projection fails.
[[nodiscard]] inline Vec3 on_model_curve(const SurfaceReference& reference,
                                         const model::Model& model, LocalIndex curve,
                                         const Vec3& point)
{
  return model.project_to_curve(curve, point, reference.curve_parameter(curve, point)).xyz;
}

}  // namespace tessera::surface
