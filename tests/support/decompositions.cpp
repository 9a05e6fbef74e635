// SPDX-License-Identifier: BSD-3-Clause
#include "support/decompositions.hpp"

namespace tessera::testing {

mesh::Decomposition slabs(const mesh::CoarseMesh& coarse, int slabs_a_material)
{
  mesh::Decomposition decomposition;
  for (LocalIndex m = 1; m <= coarse.num_materials(); ++m) {
    decomposition.subdomain_material.insert(decomposition.subdomain_material.end(),
                                            static_cast<std::size_t>(slabs_a_material), m);
  }
  decomposition.subdomain_weight.assign(decomposition.subdomain_material.size(), 1.0);
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    double y = 0.0;
    for (const LocalIndex v : coarse.tet(t)) y += 0.25 * coarse.position(v)[1];
    const auto slab = static_cast<LocalIndex>(y * slabs_a_material);
    const LocalIndex material = coarse.tet_material[static_cast<std::size_t>(t)];
    decomposition.tet_subdomain.push_back((material - 1) * slabs_a_material + slab);
  }
  return decomposition;
}

mesh::Decomposition octants(const mesh::CoarseMesh& coarse)
{
  mesh::Decomposition decomposition;
  decomposition.subdomain_material.assign(8, 1);
  decomposition.subdomain_weight.assign(8, 1.0);
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    Vec3 middle{};
    for (const LocalIndex v : coarse.tet(t)) middle = middle + 0.25 * coarse.position(v);
    const LocalIndex octant = (middle[0] > 0.5) + 2 * (middle[1] > 0.5) + 4 * (middle[2] > 0.5);
    decomposition.tet_subdomain.push_back(octant);
    decomposition.subdomain_material[at(octant)] = coarse.tet_material[at(t)];
  }
  return decomposition;
}

mesh::Decomposition one_subdomain_a_material(const mesh::CoarseMesh& coarse)
{
  mesh::Decomposition decomposition;
  for (LocalIndex m = 1; m <= coarse.num_materials(); ++m) {
    decomposition.subdomain_material.push_back(m);
    decomposition.subdomain_weight.push_back(1.0);
  }
  for (const LocalIndex m : coarse.tet_material) decomposition.tet_subdomain.push_back(m - 1);
  return decomposition;
}

}  // namespace tessera::testing
