// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace tessera::testing {

/// @brief Points in the cube from -1 to 1, the same for the same seed. Shape (size, 3).
[[nodiscard]] inline std::vector<double> points_in_cube(int size, unsigned seed = 1)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> xyz;
  for (int i = 0; i < 3 * size; ++i) xyz.push_back(number(engine));
  return xyz;
}

/// @brief Points on the unit sphere, but for rounding. Shape (size, 3).
[[nodiscard]] inline std::vector<double> points_on_sphere(int size)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> xyz;
  for (int i = 0; i < size; ++i) {
    const double z = number(engine);
    const double angle = std::numbers::pi * number(engine);
    const double radius = std::sqrt(1.0 - z * z);
    xyz.insert(xyz.end(), {radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return xyz;
}

}  // namespace tessera::testing
