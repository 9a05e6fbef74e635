// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace tessera::delaunay {

// A number as an exact sum of doubles: strongly non-overlapping, the least one first, no zeros.
// Needs rounding to nearest, and products that neither overflow nor lose bits at the lower end.
// @cite shewchuk1997
class Expansion {
 public:
  Expansion() = default;

  // a - b.
  [[nodiscard]] static Expansion difference(double a, double b);

  [[nodiscard]] int sign() const;

  friend Expansion operator+(const Expansion& a, const Expansion& b);
  friend Expansion operator-(const Expansion& a, const Expansion& b);
  friend Expansion operator*(const Expansion& a, const Expansion& b);

 private:
  void append(double part)
  {
    if (part != 0.0) parts_.push_back(part);
  }
  [[nodiscard]] Expansion scaled(double factor) const;
  [[nodiscard]] Expansion negative() const;

  std::vector<double> parts_{};
};

}  // namespace tessera::delaunay
