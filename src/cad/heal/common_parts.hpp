// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/model/assembly.hpp"

#include "cad/cad_file.hpp"
#include "cad/heal/fuse.hpp"

namespace tessera::cad {

/// @brief What solids have in common that is no film, pair by pair.
/// @param[in] fused The solids, cut where they overlap.
[[nodiscard]] std::vector<model::CommonPart> common_parts(const Shapes& solids,
                                                          const FusedSolids& fused, double thinnest,
                                                          const ShapeNames& names);

/// @brief The solids, each without what others have in common with it and get by `rule`, `first` or
/// `last`. One may have fallen apart, or be gone. Names follow.
/// @throws GeometryError if OpenCASCADE fails.
[[nodiscard]] Shapes without_common_parts(const Shapes& solids,
                                          const std::vector<model::CommonPart>& parts,
                                          model::Overlap rule, CadFile& cad);

/// @brief The pair of solids with these places in a list, as people know them.
[[nodiscard]] model::SolidPair pair_of(const Shapes& solids, std::size_t one, std::size_t other,
                                       const ShapeNames& names);

}  // namespace tessera::cad
