// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/vec3.hpp"

namespace tessera::optimize {

// A position that one vector register holds, so that it is read by one load. Trivial, so that it is
// copied as bytes.
struct alignas(32) Point {
  double x;
  double y;
  double z;
  double pad;
};

[[nodiscard]] inline Vec3 to_vec3(const Point& p) { return {p.x, p.y, p.z}; }
[[nodiscard]] inline Vec3 edge(const Point& from, const Point& to)
{
  return {to.x - from.x, to.y - from.y, to.z - from.z};
}

}  // namespace tessera::optimize
