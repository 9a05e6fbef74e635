// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::coarse {

/// @brief Fills a closed surface, whose triangles all stay. @throws NetgenError if it gives up.
using HoleFiller = std::function<surface::DomainTets(const surface::DomainSkin& hole)>;

/// @brief Tets of a domain: Delaunay tets of its skin and of a lattice inside. Local; a pure
/// function.
///
/// Where a triangle of the skin is no face of such tets, those that cross it are taken out, and the
/// filler fills the hole. A hole that it cannot fill grows by the tets around it.
/// @return Nothing if that does not help, or if the skin cuts itself. No domain of the corpus needs
/// that.
[[nodiscard]] std::optional<surface::DomainTets> fill_with_lattice(
    const surface::DomainSkin& skin, const surface::CoarseOptions& options,
    const HoleFiller& filler);

}  // namespace tessera::coarse
