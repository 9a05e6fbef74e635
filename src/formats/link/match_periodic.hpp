// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"

#include "formats/link/link_pieces.hpp"
#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief The periodic patches that the files tell of, but for pairs of which a patch has no
/// triangles. Local.
/// @param[in] outline Linked with LinkOptions::patch_points.
/// @throws InputError if the files do not say what is periodic.
[[nodiscard]] std::vector<PeriodicPatch> periodic_patches(const FileNames& names,
                                                          const Outline& outline);

/// @brief Reads all pieces once more and finds the points whose images those of Outline::periodic
/// are. A rank holds one piece, and what its pieces have of such patches.
/// @note Collective.
/// @param[in,out] mesh Gets PeriodicPatch::first_point.
/// @return By this rank's pieces: Piece::periodic_points.
/// @throws InputError on all ranks if a point is the image of none.
[[nodiscard]] std::vector<std::vector<PeriodicPoint>> match_periodic_points(
    const PieceSource& source, LinkedMesh& mesh, const comm::Communicator& comm,
    const std::function<void()>& before_each);

}  // namespace tessera::formats
