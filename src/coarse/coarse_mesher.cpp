// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/coarse_mesher.hpp"

#include <utility>
#include <vector>

#include "tessera/base/repair.hpp"

#include "coarse/lattice_fill.hpp"

namespace tessera::coarse {

DomainTets CoarseMesher::mesh_domain(const DomainSkin& skin, const CoarseOptions& options) const
{
  if (skin.vertex.empty()) return {};
  const HoleFiller filler = [&](const DomainSkin& hole) { return fill_domain(hole, options); };
  auto tets = fill_with_lattice(skin, options, filler);
  if (tets) return improve_domain(skin, std::move(*tets));
  if (is_left_out(Repair::netgen_tets)) throw MeshError("a domain cannot be filled with a lattice");
  tets = fill_domain(skin, options);
  note_repair(Repair::netgen_tets);
  return improve_domain(skin, std::move(*tets));
}

std::vector<DomainTets> CoarseMesher::mesh_domains(const CoarseSurface& surface,
                                                   const CoarseOptions& options) const
{
  std::vector<DomainTets> tets;
  for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
    tets.push_back(mesh_domain(skin_of(surface, domain), options));
  }
  return tets;
}

cut::CutMesh CoarseMesher::generate_parts(const CoarseOptions& options,
                                          const cut::CutTree& planes) const
{
  CoarseSurface surface = mesh_surface(options, planes);
  const std::vector<DomainTets> tets = mesh_domains(surface, options);
  return fill_surface(std::move(surface), tets);
}

}  // namespace tessera::coarse
