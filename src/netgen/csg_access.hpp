// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include <csg.hpp>

#include "tessera/base/vec3.hpp"

namespace tessera::netgen {

[[nodiscard]] inline ::netgen::Point<3> to_netgen(const Vec3& p) { return {p[0], p[1], p[2]}; }
[[nodiscard]] inline Vec3 from_netgen(const ::netgen::Point<3>& p) { return {p(0), p(1), p(2)}; }

/// @brief First-order distance of a point to a surface; NaN where the surface has no normal. Local.
[[nodiscard]] inline double distance(const ::netgen::Surface& surface,
                                     const ::netgen::Point<3>& point)
{
  ::netgen::Vec<3> gradient;
  surface.CalcGradient(point, gradient);
  const double value = std::abs(surface.CalcFunctionValue(point));
  return value == 0.0 ? 0.0 : value / gradient.Length();
}

/// NETGEN's own value: surfaces that differ by less, relative to the bounding box, are one surface.
inline constexpr double kIdenticSurfaces = 1e-8;

/// @brief Name of a top-level object, from 0: its material, or what the file calls the solid.
/// Local.
[[nodiscard]] inline std::string name_of_solid(const ::netgen::CSGeometry& geometry, int solid)
{
  const auto* object = geometry.GetTopLevelObject(solid);
  return object->GetMaterial().empty() ? std::string(object->GetSolid()->Name())
                                       : object->GetMaterial();
}

/// @brief A name that NETGEN gives to what has none becomes empty. Local.
[[nodiscard]] inline std::string name_unless_default(const std::string& bc_name)
{
  return bc_name == "default" ? std::string() : bc_name;
}

}  // namespace tessera::netgen
