// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"

#include "formats/link/link_pieces.hpp"
#include "formats/piece_source.hpp"

/// Periodic patches in OpenFOAM: two patches of type `cyclic`, whose faces have one order and begin
/// with points that are partners. Where partners are in two pieces, they are in patches of type
/// `processorCyclic`.
namespace tessera::formats {

/// @brief Reads all pieces once more and finds the partner of each face of a periodic patch. A rank
/// holds one piece, and what its pieces have of such patches.
/// @note Collective.
/// @param[in] mesh With Outline::periodic, and with Outline::cell_faces if there are prisms.
/// @return By this rank's pieces: Piece::cyclic_faces.
/// @throws InputError on all ranks if a face has no partner.
/// @throws ConfigError on all ranks if a patch is in two pairs.
[[nodiscard]] std::vector<std::vector<CyclicFace>> match_cyclic_faces(
    const PieceSource& source, const LinkedMesh& mesh, const comm::Communicator& comm,
    const std::function<void()>& before_each);

}  // namespace tessera::formats
