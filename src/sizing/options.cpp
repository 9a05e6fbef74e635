// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/sizing/options.hpp"

#include <array>
#include <cstddef>

namespace tessera::sizing {
namespace {

std::string defect(const Box& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] > box.max[axis]) return "box.min must not be above box.max";
  }
  return {};
}

std::string defect(const Cylinder& cylinder)
{
  return cylinder.start == cylinder.end ? "cylinder.start and cylinder.end must differ" : "";
}

std::string defect(const HalfSpace& half_space)
{
  return half_space.normal == Vec3{} ? "halfspace.normal must not be zero" : "";
}

template <class OtherShape>
std::string defect(const OtherShape& /*shape*/)
{
  return {};
}

}  // namespace

std::string_view word_of(const Shape& shape)
{
  constexpr auto kWords = std::to_array<std::string_view>(
      {"box", "ball", "cylinder", "halfspace", "patch", "material", "curve"});
  static_assert(kWords.size() == std::variant_size_v<Shape>);
  return kWords[shape.index()];
}

std::string defect_of(const SizeRegion& region)
{
  return std::visit([](const auto& shape) { return defect(shape); }, region.shape);
}

}  // namespace tessera::sizing
