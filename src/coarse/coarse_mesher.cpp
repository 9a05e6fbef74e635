// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/coarse_mesher.hpp"

#include <utility>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/coarse/optimize_domain.hpp"

#include "coarse/domains/lattice_fill.hpp"

namespace tessera::coarse {

surface::DomainTets CoarseMesher::mesh_domain(const surface::DomainSkin& skin,
                                              const surface::CoarseOptions& options) const
{
  if (skin.vertex.empty()) return {};
  const HoleFiller filler = [&](const surface::DomainSkin& hole) {
    return fill_domain(hole, options);
  };
  auto tets = fill_with_lattice(skin, options, filler);
  if (tets) return optimize_domain(skin, std::move(*tets));
  if (is_left_out(Repair::netgen_tets)) throw MeshError("a domain cannot be filled with a lattice");
  tets = fill_domain(skin, options);
  note_repair(Repair::netgen_tets);
  return optimize_domain(skin, std::move(*tets));
}

std::vector<surface::DomainTets> CoarseMesher::mesh_domains(
    const surface::CoarseSurface& surface, const surface::CoarseOptions& options) const
{
  std::vector<surface::DomainTets> tets;
  for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
    tets.push_back(mesh_domain(surface::skin_of(surface, domain), options));
  }
  return tets;
}

cut::CutMesh CoarseMesher::generate_parts(const surface::CoarseOptions& options,
                                          const cut::CutTree& planes) const
{
  surface::CoarseSurface surface = mesh_surface(options, planes);
  const std::vector<surface::DomainTets> tets = mesh_domains(surface, options);
  cut::CutMesh filled = surface::fill_surface(std::move(surface), tets);
  mesh::validate(filled.mesh);
  return filled;
}

}  // namespace tessera::coarse
