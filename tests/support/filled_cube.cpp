// SPDX-License-Identifier: BSD-3-Clause
#include "support/filled_cube.hpp"

#include <utility>

#include "tessera/mesh/lattice.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/count_pieces.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::testing {

subdomain::FilledPiece fill_of(const Body& body, int levels, LocalIndex subdomain,
                               const fill::FillTry& how)
{
  const FlatModel model;
  const mesh::ProjectionLimiter limiter;
  const refine::RefineContext refine{body.coarse, body.skeleton, model, limiter, levels, true};
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const auto layers = subdomain::layer_tables(body.coarse, body.skeleton,
                                              mesh::lattice_levels(body.skeleton, levels));
  return subdomain::fill_subdomain(cut, refine, subdomain, how, *netgen::make_fill_kernel(),
                                   layers ? &*layers : nullptr);
}

void FilledCube::SetUpTestSuite()
{
  const mesh::CoarseMesh cube = two_material_cube(2);
  Body body(cube, slabs(cube, 2));
  std::vector<subdomain::FilledPiece> pieces;
  std::vector<number::PieceCounts> counts;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    pieces.push_back(fill_of(body, kLevels, s));
    const subdomain::PieceSummary& summary = pieces.back().result.summary;
    counts.push_back(subdomain::counts_of(summary));
  }
  const auto ids = number::IdLayout::by_host(mesh::HostLayout(body.skeleton),
                                             mesh::lattice_levels(body.skeleton, kLevels), counts);
  shared_ = new Shared{std::move(body), std::move(pieces), ids, "mm"};
}

void FilledCube::TearDownTestSuite()
{
  delete shared_;
  shared_ = nullptr;
}

}  // namespace tessera::testing
