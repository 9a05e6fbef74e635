// SPDX-License-Identifier: BSD-3-Clause
// Connects points by Delaunay tets, and says how many a second of CPU time:
//   delaunay_bench [NUM_POINTS]
// Points are random in a cube, those of a body-centred lattice, and random on a sphere (a hundredth
// as many: nearly all tests are exact there).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <random>
#include <vector>

#include "tessera/delaunay/tetrahedralize.hpp"

namespace tessera {
namespace {

using Points = std::vector<double>;

Points random_in_cube(int size)
{
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  Points xyz;
  for (int i = 0; i < 3 * size; ++i) xyz.push_back(number(engine));
  return xyz;
}

Points lattice(int size)
{
  const int n = static_cast<int>(std::cbrt(0.5 * size));
  Points xyz;
  for (int i = 0; i < 2 * n * n * n; ++i) {
    const double shift = i % 2 == 0 ? 0.0 : 0.5;
    const int cell = i / 2;
    for (const int place : {cell % n, cell / n % n, cell / n / n}) {
      xyz.push_back(0.09375 * (place + shift));
    }
  }
  return xyz;
}

Points random_on_sphere(int size)
{
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Points xyz;
  for (int i = 0; i < size; ++i) {
    const double z = number(engine);
    const double angle = std::numbers::pi * number(engine);
    const double radius = std::sqrt(1.0 - z * z);
    xyz.insert(xyz.end(), {radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return xyz;
}

void run(const char* name, const Points& xyz)
{
  const std::clock_t begin = std::clock();
  const int num_tets = delaunay::tetrahedralize(xyz).num_tets();
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("%-16s %9zu points, %9d tets, %7.2f s, %7.0f tets/s\n", name, xyz.size() / 3,
              num_tets, seconds, num_tets / seconds);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  const int size = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  tessera::run("random in a cube", tessera::random_in_cube(size));
  tessera::run("lattice", tessera::lattice(size));
  tessera::run("on a sphere", tessera::random_on_sphere(size / 100));
}
