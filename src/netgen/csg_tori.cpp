// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_tori.hpp"

#include <memory>
#include <string>

namespace tessera::netgen {
namespace {

using ::netgen::Torus;

// As NETGEN's own where r is 1, and of the same shape at any other scale. It is twice the
// curvature: with as few edges as on other surfaces NETGEN's front leaves gaps.
class MendedTorus final : public Torus {
 public:
  using Torus::Torus;

  // NOLINTBEGIN(readability-identifier-naming): NETGEN's
  ::netgen::Primitive* Copy() const override
  {
    return new MendedTorus(Center(), NormalToPlane(), LargeRadius(), SmallRadius());
  }

  // Of the squared distance from the middle circle: its second derivatives are 2, or a few more.
  double HesseNorm() const override { return 4.0; }
  double MaxCurvature() const override { return 2.0 / SmallRadius(); }
  // NOLINTEND(readability-identifier-naming)
};

// In its place, as the geometry and its solids hold pointers to it that nobody can change.
void mend(Torus& torus)
{
  static_assert(sizeof(MendedTorus) == sizeof(Torus));
  const int surface_id = torus.GetSurfaceId(0);
  const std::string name = torus.Name();
  const double max_size = torus.GetMaxH();
  const int bc_property = torus.GetBCProperty();
  const std::string bc_name = torus.GetBCName();
  const bool is_inverse = torus.Inverse();
  const auto centre = torus.Center();
  const auto normal = torus.NormalToPlane();
  const double large_radius = torus.LargeRadius();
  const double small_radius = torus.SmallRadius();

  std::destroy_at(&torus);
  auto& mended = *std::construct_at(reinterpret_cast<MendedTorus*>(&torus), centre, normal,
                                    large_radius, small_radius);
  mended.SetSurfaceId(0, surface_id);
  mended.SetName(name.c_str());
  mended.SetMaxH(max_size);
  mended.SetBCProperty(bc_property);
  mended.SetBCName(bc_name);
  mended.SetInverse(is_inverse);
}

}  // namespace

void mend_tori(::netgen::CSGeometry& geometry)
{
  for (int i = 0; i < geometry.GetNSurf(); ++i) {
    const auto* torus = dynamic_cast<const Torus*>(geometry.GetSurface(i));
    if (torus != nullptr) mend(const_cast<Torus&>(*torus));
  }
}

}  // namespace tessera::netgen
