// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/predicted_fine_tets.hpp"

#include "tessera/mesh/tet_grading.hpp"

namespace tessera::decompose {

std::vector<double> predicted_fine_tets(const mesh::CoarseMesh& mesh,
                                        const mesh::EdgeLevels& levels)
{
  std::vector<double> tets;
  tets.reserve(at(mesh.num_tets()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    tets.push_back(static_cast<double>(mesh::num_children(mesh::tet_grading(mesh, levels, t))));
  }
  return tets;
}

}  // namespace tessera::decompose
