// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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

/// @brief Unit normal of a surface at a point on it; zero where it has none. Local.
[[nodiscard]] inline Vec3 normal_of_surface(const ::netgen::CSGeometry& geometry, int surface,
                                            const Vec3& point)
{
  ::netgen::Vec<3> gradient;
  geometry.GetSurface(surface)->CalcGradient(to_netgen(point), gradient);
  return unit({gradient(0), gradient(1), gradient(2)});
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

/// @brief Whether the file tells faces, edges or points by numbers of its solids: identified or
/// singular ones. Local.
[[nodiscard]] inline bool is_numbered(const ::netgen::CSGeometry& geometry)
{
  return geometry.GetNIdentifications() > 0 || geometry.singfaces.Size() > 0
         || geometry.singedges.Size() > 0 || geometry.singpoints.Size() > 0;
}

/// @brief Largest edge that the file wants in a solid, from 0. Local.
[[nodiscard]] inline double max_size_of_solid(const ::netgen::CSGeometry& geometry, int solid)
{
  const ::netgen::TopLevelObject& object = *geometry.GetTopLevelObject(solid);
  return std::min(object.GetMaxH(), object.GetSolid()->GetMaxH());
}

/// @brief A name that NETGEN gives to what has none becomes empty. Local.
[[nodiscard]] inline std::string name_unless_default(const std::string& bc_name)
{
  return bc_name == "default" ? std::string() : bc_name;
}

}  // namespace tessera::netgen
