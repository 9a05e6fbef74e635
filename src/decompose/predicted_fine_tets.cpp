// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/predicted_fine_tets.hpp"

#include <cmath>

namespace tessera::decompose {

std::vector<double> predicted_fine_tets(const mesh::CoarseMesh& mesh, int levels)
{
  return std::vector<double>(at(mesh.num_tets()), std::ldexp(1.0, 3 * levels));
}

}  // namespace tessera::decompose
