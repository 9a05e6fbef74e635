// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/coarse_mesher.hpp"

#include <span>
#include <utility>

namespace tessera::coarse {
DividedSurface CoarseMesher::divide(const CoarseSurface& surface,
                                    const CoarseOptions& options) const
{
  const MembraneMesher mesher = [&](const DomainSkin& skin, const MembraneBorder& border) {
    return mesh_membrane(skin, border, options);
  };
  return divide_domains(surface, mesher);
}

std::vector<DomainTets> CoarseMesher::join_domains(const CoarseSurface& whole,
                                                   const DividedSurface& divided,
                                                   std::vector<DomainTets> pieces) const
{
  std::vector<DomainTets> domains;
  LocalIndex first = 0;
  for (LocalIndex d = 1; d <= whole.num_domains(); ++d) {
    const LocalIndex last = first + divided.num_pieces[at(d - 1)];
    if (last == first + 1) {
      domains.push_back(std::move(pieces[at(first)]));
    } else {
      const DomainSkin skin = skin_of(whole, d);
      std::vector<DomainSkin> skins;
      for (LocalIndex p = first; p < last; ++p) skins.push_back(skin_of(divided.surface, p + 1));
      domains.push_back(
          improve_domain(skin, join_pieces(skin, skins, std::span(pieces).subspan(at(first)))));
    }
    first = last;
  }
  return domains;
}

std::vector<DomainTets> CoarseMesher::mesh_domains(const CoarseSurface& surface,
                                                   const CoarseOptions& options) const
{
  const DividedSurface divided = divide(surface, options);
  const auto fill = [&](const DividedSurface& in_pieces) {
    std::vector<DomainTets> pieces;
    for (LocalIndex piece = 1; piece <= in_pieces.surface.num_domains(); ++piece) {
      const DomainSkin skin = skin_of_piece(in_pieces, piece);
      pieces.push_back(skin.is_piece ? fill_domain(skin, options) : mesh_domain(skin, options));
    }
    return join_domains(surface, in_pieces, std::move(pieces));
  };
  try {
    return fill(divided);
  } catch (const NetgenError&) {
    if (divided.surface.num_domains() == surface.num_domains()) throw;
  }
  return fill(undivided(surface));
}

cut::CutMesh CoarseMesher::generate_parts(const CoarseOptions& options,
                                          const cut::CutTree& planes) const
{
  CoarseSurface surface = mesh_surface(options, planes);
  const std::vector<DomainTets> tets = mesh_domains(surface, options);
  return fill_surface(std::move(surface), tets);
}

}  // namespace tessera::coarse
