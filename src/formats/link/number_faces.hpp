// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {

/// @brief Faces with both tets in the piece. Local.
[[nodiscard]] GlobalIndex num_inner_faces(const PieceCounts& piece);

/// @brief Faces between two tets of which the lower one is in the piece. Local.
[[nodiscard]] GlobalIndex num_owned_faces(const Outline& outline, LocalIndex piece);

/// @brief Numbers the faces between pieces, as SeamFace says. The piece of the lower tet knows the
/// number, and tells it to the other one. @note Collective.
/// @param[in] first_piece Number of this rank's first piece.
/// @param[in,out] links Of this rank's pieces, with their seams.
void number_seam_faces(const Outline& outline, LocalIndex first_piece,
                       const comm::Communicator& comm, std::vector<PieceLinks>& links);

}  // namespace tessera::formats
