// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/cut_mesh.hpp"

#include "tessera/fill/size_samples.hpp"
#include "tessera/plan/fold_test.hpp"

namespace tessera::pipeline {

CutMesh::CutMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut)
    : coarse(coarse_mesh),
      decomposition(cut),
      skeleton(mesh::build_skeleton(coarse, decomposition)),
      tets(mesh::subdomain_tets(decomposition)),
      seam_units(mesh::units_on_seams(skeleton, decomposition)),
      on_geometry(plan::vertices_on_geometry(coarse, skeleton)),
      vertex_size(fill::vertex_sizes(coarse))
{
}

}  // namespace tessera::pipeline
