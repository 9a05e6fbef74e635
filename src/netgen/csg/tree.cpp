// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/tree.hpp"

#include <algorithm>

#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::Primitive;
using ::netgen::Solid;
using Point = ::netgen::Point<3>;

// NETGEN keeps the operation of a node to itself. In an explicit instantiation access is not
// checked.
Solid::optyp private_operation(const Solid& solid);
template <auto Member>
struct Access {
  friend Solid::optyp private_operation(const Solid& solid) { return solid.*Member; }
};
template struct Access<&Solid::op>;

Place place_of(const Point& point, const Primitive& body, double tolerance)
{
  switch (body.PointInSolid(point, tolerance)) {
    case ::netgen::IS_INSIDE:
      return Place::inside;
    case ::netgen::IS_OUTSIDE:
      return Place::outside;
    default:
      return Place::on;
  }
}

Place complement(Place place)
{
  if (place == Place::on) return place;
  return place == Place::inside ? Place::outside : Place::inside;
}

}  // namespace

Operation operation_of(const Solid& solid)
{
  switch (private_operation(solid)) {
    case Solid::SECTION:
      return Operation::both;
    case Solid::UNION:
      return Operation::either;
    case Solid::SUB:
      return Operation::complement;
    case Solid::ROOT:
      return Operation::named;
    default:
      return Operation::body;
  }
}

Place place_of(const Point& point, Solid& solid, double tolerance)
{
  const auto place = [&](Solid& operand) { return place_of(point, operand, tolerance); };
  switch (operation_of(solid)) {
    case Operation::body:
      return place_of(point, *solid.GetPrimitive(), tolerance);
    case Operation::named:
      return place(*solid.S1());
    case Operation::complement:
      return complement(place(*solid.S1()));
    case Operation::both:
      return std::min(place(*solid.S1()), place(*solid.S2()));
    default:
      return std::max(place(*solid.S1()), place(*solid.S2()));
  }
}

std::set<int> surfaces_of(const ::netgen::CSGeometry& geometry, Solid& solid)
{
  std::set<const Primitive*> bodies;
  for_each_body(solid, [&](const Primitive& body) { bodies.insert(&body); });
  std::set<int> surfaces;
  for (int s = 0; s < geometry.GetNSurf(); ++s) {
    if (bodies.contains(geometry.surf2prim[s])) {
      surfaces.insert(geometry.GetSurfaceClassRepresentant(s));
    }
  }
  return surfaces;
}

std::set<int> surfaces_at(const Point& point, const ::netgen::CSGeometry& geometry, Solid& solid,
                          double tolerance)
{
  std::set<int> surfaces;
  if (place_of(point, solid, tolerance) != Place::on) return surfaces;
  if (const Primitive* const body = solid.GetPrimitive()) {
    NetgenArray<int> found;
    body->GetTangentialSurfaceIndices(point, found, tolerance);
    for (const int s : found) surfaces.insert(geometry.GetSurfaceClassRepresentant(s));
    return surfaces;
  }
  surfaces = surfaces_at(point, geometry, *solid.S1(), tolerance);
  if (solid.S2() != nullptr) surfaces.merge(surfaces_at(point, geometry, *solid.S2(), tolerance));
  return surfaces;
}

}  // namespace tessera::netgen
