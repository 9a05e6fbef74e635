// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include <csg.hpp>

#include "tessera/base/types.hpp"

namespace tessera::netgen {

/// The tree of operations that a solid of NETGEN's CSG is. NETGEN's own functions that walk through
/// it are hidden in the library of 6.2.2501; those of the bodies at its leaves are virtual.

enum class Operation { body, both, either, complement, named };

[[nodiscard]] Operation operation_of(const ::netgen::Solid& solid);

/// @brief Calls `visit(Primitive&)` for each body of a solid, from left to right. Local.
template <class Visit>
void for_each_body(::netgen::Solid& solid, const Visit& visit)
{
  if (::netgen::Primitive* const body = solid.GetPrimitive()) return visit(*body);
  for_each_body(*solid.S1(), visit);
  if (solid.S2() != nullptr) for_each_body(*solid.S2(), visit);
}

enum class Place { outside, on, inside };

/// @brief Where a point is. Nearer than the tolerance to the surface of a body it is on that.
/// Local.
/// @param[in] tolerance File length unit.
[[nodiscard]] Place place_of(const ::netgen::Point<3>& point, ::netgen::Solid& solid,
                             double tolerance);

/// @brief Representants of the surfaces of a solid's bodies. Local.
[[nodiscard]] std::set<int> surfaces_of(const ::netgen::CSGeometry& geometry,
                                        ::netgen::Solid& solid);

/// @brief The same of those only that go through a point and bound the solid there. Local.
/// @param[in] tolerance File length unit.
[[nodiscard]] std::set<int> surfaces_at(const ::netgen::Point<3>& point,
                                        const ::netgen::CSGeometry& geometry,
                                        ::netgen::Solid& solid, double tolerance);

}  // namespace tessera::netgen
