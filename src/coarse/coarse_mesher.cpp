// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/coarse_mesher.hpp"

#include <utility>
#include <vector>

namespace tessera::coarse {

mesh::CoarseMesh CoarseMesher::generate(const CoarseOptions& options) const
{
  CoarseSurface surface = mesh_surface(options);
  std::vector<DomainSkin> skins;
  std::vector<DomainTets> tets;
  for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
    skins.push_back(skin_of(surface, domain));
    tets.push_back(mesh_domain(skins.back(), options));
  }
  return fill_surface(std::move(surface), skins, tets);
}

}  // namespace tessera::coarse
