// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_tori.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "tessera/base/repair.hpp"

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

  // Of the squared distance from the middle circle less r^2: its second derivatives near the
  // surface are 2, and 2 r / (R - r) around the axis at the hole.
  double HesseNorm() const override { return 4.0 * SmallRadius() / least_radius(); }
  double MaxCurvature() const override { return 2.0 / least_radius(); }
  // NOLINTEND(readability-identifier-naming)

 private:
  // Of the tube or the hole. One that goes through its own axis has no hole.
  double least_radius() const
  {
    const double hole = LargeRadius() - SmallRadius();
    return hole > 0.0 ? std::min(hole, SmallRadius()) : SmallRadius();
  }
};

// In its place, as the geometry and its solids hold pointers to it that nobody can change. They go
// on to be used for another class of the same base, which the language does not promise to work; it
// does with virtual functions that another library calls.
void mend(Torus& torus)
{
  static_assert(sizeof(MendedTorus) == sizeof(Torus) && alignof(MendedTorus) == alignof(Torus));
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
  if (is_left_out(Repair::torus_sizes)) return;
  for (int i = 0; i < geometry.GetNSurf(); ++i) {
    const auto* torus = dynamic_cast<const Torus*>(geometry.GetSurface(i));
    if (torus == nullptr) continue;
    mend(const_cast<Torus&>(*torus));
    note_repair(Repair::torus_sizes);
  }
}

}  // namespace tessera::netgen
