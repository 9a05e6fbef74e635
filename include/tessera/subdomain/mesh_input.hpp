// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/assemble.hpp"

/// From the files of a mesh to what ranks hold of it. All functions are collective, and throw
/// InputError on all ranks.
namespace tessera::subdomain {

/// @brief The piece files of an index, read by rank 0, so that no rank can see another list.
[[nodiscard]] std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& index,
                                                           const comm::Communicator& comm);

/// @brief The piece files of an index beside mesh.pvtu, to which it belongs, if it is there:
/// boundary.pvtu or lines.pvtu.
[[nodiscard]] std::optional<std::vector<std::filesystem::path>> pieces_beside(
    const std::filesystem::path& mesh, const std::string& name, const comm::Communicator& comm);

/// @brief Reads the pieces of a mesh and of its boundary, each rank some that stand together.
/// @param[in] before_each Called before each file is read; what it throws, all ranks throw.
[[nodiscard]] migrate::MeshPieces read_pieces(const std::filesystem::path& index,
                                              const comm::Communicator& comm,
                                              const std::function<void()>& before_each);

using Texts = std::map<std::string, std::vector<std::string>>;

/// @brief Field texts of the first piece that has any, the same on all ranks; "material_names",
/// "patch_names" and "length_unit" are always there.
[[nodiscard]] Texts field_texts_of(const migrate::MeshPieces& pieces,
                                   const comm::Communicator& comm);

/// @brief migrate::assemble(); its errors name the index.
[[nodiscard]] migrate::AssembledMesh assemble_pieces(const std::filesystem::path& index,
                                                     const migrate::MeshPieces& pieces,
                                                     const comm::Communicator& comm);

}  // namespace tessera::subdomain
