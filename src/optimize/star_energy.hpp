// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/vec3.hpp"

namespace tessera::optimize {

// The sum of eta^-3 of the tets between a point and some triangles, as a function of the point;
// also where tets are inverted. For the few places that need more than a Newton step of a kernel.
//
// Six times the volume, w, is replaced by h(w) = (w + sqrt(w^2 + 4 delta^2)) / 2. It is positive
// everywhere, small where w is negative, and near w where w is large. So the energy is finite, and
// if delta is small enough its least value has no inverted tet.
// @cite escobar2003
class StarEnergy {
 public:
  void clear() { faces_.clear(); }

  // Outward from the point.
  void add_face(const Vec3& a, const Vec3& b, const Vec3& c) { faces_.push_back({a, b, c}); }

  // The largest energy of a tet, without delta; infinite if one is flat or inverted.
  [[nodiscard]] double worst(const Vec3& point) const;

  // Six times the volume of a regular tet of the mean size: what delta is to be compared with.
  [[nodiscard]] double typical_volume(const Vec3& point) const;

  // The point after some Newton steps, each of which lowers the energy.
  [[nodiscard]] Vec3 minimize(Vec3 point, double delta, int num_steps) const;

 private:
  [[nodiscard]] double energy(const Vec3& point, double delta) const;
  [[nodiscard]] Vec3 newton_step(const Vec3& point, double delta) const;

  std::vector<std::array<Vec3, 3>> faces_{};
};

}  // namespace tessera::optimize
