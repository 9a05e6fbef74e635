// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"

#include "formats/link/link_pieces.hpp"
#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief Reads all pieces once more and gives each the cells of others that share a point with it.
/// A rank holds one piece, and the ghosts of its pieces.
/// @note Collective. @throws InputError on all ranks.
/// @return By this rank's pieces.
[[nodiscard]] std::vector<Ghosts> collect_ghosts(const PieceSource& source, const LinkedMesh& mesh,
                                                 const comm::Communicator& comm,
                                                 const std::function<void()>& before_each);

}  // namespace tessera::formats
