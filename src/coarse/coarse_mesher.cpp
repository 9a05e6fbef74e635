// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/coarse_mesher.hpp"

#include <utility>
#include <vector>

namespace tessera::coarse {

cut::CutMesh CoarseMesher::generate_parts(const CoarseOptions& options,
                                          const cut::CutTree& planes) const
{
  CoarseSurface surface = mesh_surface(options, planes);
  std::vector<DomainSkin> skins;
  std::vector<DomainTets> tets;
  for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
    skins.push_back(skin_of(surface, domain));
    tets.push_back(mesh_domain(skins.back(), options));
  }
  return fill_surface(std::move(surface), skins, tets);
}

}  // namespace tessera::coarse
