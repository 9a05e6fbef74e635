// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/predicted_fine_tets.hpp"

#include <cmath>
#include <cstddef>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::decompose {

std::vector<double> predicted_fine_tets(const mesh::CoarseMesh& mesh, int levels)
{
  const double regular_tet = 1.0 / (6.0 * std::sqrt(2.0));  // volume for edge length 1
  std::vector<double> prediction(static_cast<std::size_t>(mesh.num_tets()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = mesh.tet(t);
    double length = 0.0;
    for (const auto& edge : mesh::kTetEdgeCorners) {
      length += norm(mesh.position(tet[edge[1]]) - mesh.position(tet[edge[0]])) / 6.0;
    }
    const double volume = tet_volume(mesh.position(tet[0]), mesh.position(tet[1]),
                                     mesh.position(tet[2]), mesh.position(tet[3]));
    const double shape = volume / (regular_tet * length * length * length);
    prediction[static_cast<std::size_t>(t)] = std::ldexp(shape, 3 * levels);
  }
  return prediction;
}

}  // namespace tessera::decompose
