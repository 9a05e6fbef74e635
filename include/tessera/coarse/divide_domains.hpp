// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/coarse/membrane.hpp"

namespace tessera::coarse {

/// @brief A surface whose domains are *pieces* of those of another one.
struct DividedSurface {
  CoarseSurface surface{};               ///< Vertices of the other one come first.
  std::vector<LocalIndex> num_pieces{};  ///< Shape (domains of the other one); pieces are in the
                                         ///< order of their domains.

  static auto fields(auto& self) { return std::tie(self.surface, self.num_pieces); }
};

/// @brief The skin of piece `piece`, from 1. Local.
[[nodiscard]] DomainSkin skin_of_piece(const DividedSurface& divided, LocalIndex piece);

/// @brief As many tets as a piece should have: what NETGEN fills in half a second.
inline constexpr double kTetsPerPiece = 25e3;

/// @brief How many tets a domain will have at least, by its triangles and its largest edge. Local.
[[nodiscard]] double predicted_tets(const DomainSkin& skin);

/// @brief Whether divide_domains() would divide one, if it can. Local.
[[nodiscard]] bool has_large_domain(const CoarseSurface& surface,
                                    double tets_per_piece = kTetsPerPiece);

/// @brief Every domain as one piece. Local.
[[nodiscard]] DividedSurface undivided(CoarseSurface surface);

/// @brief Divides large domains by membranes between their surfaces, so that their pieces can be
/// filled at the same time. Local.
///
/// Planes are chosen by cut::choose_planes(). The surface stays as it is: a membrane ends at edges
/// of it. Where that cannot be done a piece stays whole. How many pieces there are depends on the
/// surface alone.
/// @param[in] tets_per_piece  Domains that will have less than twice as many stay whole.
[[nodiscard]] DividedSurface divide_domains(const CoarseSurface& surface,
                                            const MembraneMesher& mesher,
                                            double tets_per_piece = kTetsPerPiece);

/// @brief The tets of all pieces of a domain as those of the domain. Vertices of membranes are free
/// then. Local.
/// @param[in] whole   skin_of() the domain, before it was divided.
/// @param[in] skins   skin_of() its pieces, in their order.
/// @param[in] pieces  What fills these; more may follow.
[[nodiscard]] DomainTets join_pieces(const DomainSkin& whole, const std::vector<DomainSkin>& skins,
                                     std::span<const DomainTets> pieces);

}  // namespace tessera::coarse
