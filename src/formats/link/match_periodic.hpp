// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"

#include "formats/link/link_pieces.hpp"
#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief Reads all pieces once more and finds the points whose images those of periodic patches
/// are. A rank holds one piece, and what its pieces have of such patches. Pairs of which a patch
/// has no triangles are left out.
/// @note Collective.
/// @param[in,out] mesh Linked with LinkOptions::patch_points; gets Outline::periodic.
/// @return By this rank's pieces: Piece::periodic_points.
/// @throws InputError on all ranks if the files do not say what is periodic, or if a point is the
/// image of none.
[[nodiscard]] std::vector<std::vector<PeriodicPoint>> match_periodic_patches(
    const PieceSource& source, LinkedMesh& mesh, const comm::Communicator& comm,
    const std::function<void()>& before_each);

}  // namespace tessera::formats
