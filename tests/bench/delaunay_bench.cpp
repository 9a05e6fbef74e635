// SPDX-License-Identifier: BSD-3-Clause
// Connects points by Delaunay tets, and says how many a second of CPU time:
//   delaunay_bench [NUM_POINTS]
// Points are random in a cube, those of a body-centred lattice, and random on a sphere (a hundredth
// as many: nearly all tests are exact there).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "tessera/delaunay/tetrahedralize.hpp"

#include "support/random_points.hpp"

namespace tessera {
namespace {

using Points = std::vector<double>;

constexpr double kLatticeSide = 0.09375;

Points lattice(int size)
{
  const int n = static_cast<int>(std::cbrt(0.5 * size));
  Points xyz;
  for (int i = 0; i < 2 * n * n * n; ++i) {
    const double shift = i % 2 == 0 ? 0.0 : 0.5;
    const int cell = i / 2;
    for (const int place : {cell % n, cell / n % n, cell / n / n}) {
      xyz.push_back(kLatticeSide * (place + shift));
    }
  }
  return xyz;
}

void run(const char* name, const Points& xyz, double lattice_side = 0.0)
{
  const std::vector<double> sides(lattice_side > 0.0 ? xyz.size() / 3 : 0, lattice_side);
  const std::clock_t begin = std::clock();
  const int num_tets = delaunay::tetrahedralize(xyz, sides).num_tets();
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("%-16s %9zu points, %9d tets, %7.2f s, %7.0f tets/s\n", name, xyz.size() / 3,
              num_tets, seconds, num_tets / seconds);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  const int size = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  tessera::run("random in a cube", tessera::testing::points_in_cube(size));
  tessera::run("lattice", tessera::lattice(size));
  tessera::run("lattice, known", tessera::lattice(size), tessera::kLatticeSide);
  tessera::run("on a sphere", tessera::testing::points_on_sphere(size / 100));
}
