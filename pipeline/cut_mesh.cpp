// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/cut_mesh.hpp"

#include <algorithm>

#include "tessera/fill/size_samples.hpp"
#include "tessera/plan/fold_test.hpp"

namespace tessera::pipeline {

CutMesh::CutMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
                 double largest_size)
    : coarse(coarse_mesh),
      decomposition(cut),
      skeleton(mesh::build_skeleton(coarse, decomposition)),
      tets(mesh::subdomain_tets(decomposition)),
      seam_units(mesh::units_on_seams(skeleton, decomposition)),
      on_geometry(plan::vertices_on_geometry(coarse, skeleton)),
      vertex_size(fill::vertex_sizes(coarse))
{
  for (double& size : vertex_size) size = std::min(size, largest_size);
}

}  // namespace tessera::pipeline
