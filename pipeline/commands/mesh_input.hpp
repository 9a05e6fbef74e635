// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/assemble.hpp"

namespace tessera::pipeline {

/// @brief The piece files of an index, read by rank 0, so that no rank can see another list.
/// @note Collective. @throws InputError on all ranks.
[[nodiscard]] std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& index,
                                                           const comm::Communicator& comm);

/// @brief The piece files of boundary.pvtu beside mesh.pvtu, to which it belongs, if it is there.
/// @note Collective. @throws InputError on all ranks.
[[nodiscard]] std::optional<std::vector<std::filesystem::path>> boundary_pieces_of(
    const std::filesystem::path& mesh, const comm::Communicator& comm);

/// @brief Reads the pieces of a mesh and of its boundary, each rank some that stand together.
/// @note Collective. @throws InputError on all ranks.
[[nodiscard]] migrate::MeshPieces read_pieces(const std::filesystem::path& index,
                                              const comm::Communicator& comm);

}  // namespace tessera::pipeline
