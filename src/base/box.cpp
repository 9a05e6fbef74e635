// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box.hpp"

namespace tessera {

Box bounding_box(std::span<const double> xyz)
{
  Box box;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) box.include(point_at(xyz, i));
  return box;
}

Box bounding_box(std::span<const Vec3> points)
{
  Box box;
  for (const Vec3& point : points) box.include(point);
  return box;
}

double box_diagonal(std::span<const double> xyz)
{
  return xyz.empty() ? 0.0 : bounding_box(xyz).diagonal();
}

}  // namespace tessera
