// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/expected_tets.hpp"

#include <array>
#include <cmath>

#include "tessera/base/vec3.hpp"

namespace tessera::fill {
namespace {

// Tets in the cube of the wanted edge length, and for each fine triangle of the skin: fitted to the
// meshes that the header names. Regular tets, which fill no space, would be 8.5 a cube.
constexpr double kTetsACube = 8.6;
constexpr double kTetsASkinTriangle = 0.7;

// Mean of 1 / size^3 over the middles of a tet's four corner children.
double mean_density(const std::array<double, 4>& corner_size)
{
  const double sum = corner_size[0] + corner_size[1] + corner_size[2] + corner_size[3];
  double density = 0.0;
  for (const double corner : corner_size)
    density += 0.25 * std::pow(0.5 * corner + 0.125 * sum, -3);
  return density;
}

}  // namespace

double expected_tets(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> tets,
                     LocalIndex num_skin_triangles, const std::vector<double>& vertex_size,
                     int levels)
{
  double cubes = 0.0;
  for (const LocalIndex t : tets) {
    const auto tet = coarse.tet(t);
    const double volume = tet_volume(coarse.position(tet[0]), coarse.position(tet[1]),
                                     coarse.position(tet[2]), coarse.position(tet[3]));
    cubes += volume
             * mean_density({vertex_size[at(tet[0])], vertex_size[at(tet[1])],
                             vertex_size[at(tet[2])], vertex_size[at(tet[3])]});
  }
  return kTetsACube * std::ldexp(cubes, 3 * levels)
         + kTetsASkinTriangle * std::ldexp(static_cast<double>(num_skin_triangles), 2 * levels);
}

}  // namespace tessera::fill
