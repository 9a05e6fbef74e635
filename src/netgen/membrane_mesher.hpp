// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/membrane.hpp"
#include "tessera/coarse/options.hpp"

namespace tessera::netgen {

/// @brief Triangles inside of a border on a skin, by NETGEN's mesher of plane surfaces. They lie in
/// the plane but for those at the border, and are as large as its tets would be there.
/// @return Without triangles if NETGEN gives up.
/// @note Local; may crash or hang inside NETGEN.
[[nodiscard]] coarse::Membrane mesh_membrane(const coarse::DomainSkin& skin,
                                             const coarse::MembraneBorder& border,
                                             const coarse::CoarseOptions& options);

}  // namespace tessera::netgen
