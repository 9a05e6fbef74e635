// SPDX-License-Identifier: BSD-3-Clause
#include "filled_cube.hpp"

#include <utility>

#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::testing {

pipeline::FilledPiece fill_of(const Body& body, int levels, LocalIndex subdomain)
{
  const FlatModel model;
  const mesh::Damping damping;
  const refine::RefineContext refine{body.coarse, body.skeleton, model, damping, levels, true};
  const auto seam_units = mesh::units_on_seams(body.skeleton, body.decomposition);
  const auto vertex_size = fill::vertex_sizes(body.coarse);
  const auto kernel = netgen::make_fill_kernel();
  return pipeline::fill_subdomain({refine, body.decomposition, seam_units, vertex_size}, subdomain,
                                  *kernel, {});
}

void FilledCube::SetUpTestSuite()
{
  const mesh::CoarseMesh cube = two_material_cube(2);
  Body body(cube, slabs(cube, 2));
  std::vector<pipeline::FilledPiece> pieces;
  std::vector<number::PieceCounts> counts;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    pieces.push_back(fill_of(body, kLevels, s));
    const pipeline::PieceSummary& summary = pieces.back().result.summary;
    counts.push_back({summary.num_interior_vertices, summary.num_tets, summary.num_boundary});
  }
  const number::IdLayout ids(mesh::UnitLayout(body.skeleton), mesh::lattice::intervals(kLevels),
                             counts);
  shared_ = new Shared{std::move(body), std::move(pieces), ids, "mm"};
}

void FilledCube::TearDownTestSuite()
{
  delete shared_;
  shared_ = nullptr;
}

}  // namespace tessera::testing
