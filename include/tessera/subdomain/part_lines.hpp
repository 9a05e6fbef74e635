// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

/// The edges on lines inside of solids, where a mesh is cut anew. They are few beside its tets, so
/// every rank holds all of them.
namespace tessera::subdomain {

/// @brief Those of lines.pvtu beside mesh.pvtu, if it is there, without ids of points. Points that
/// files share stand several times; edges are numbered anew.
/// @note Collective. @throws InputError on all ranks, naming a file.
[[nodiscard]] std::optional<mesh::MeshArrays> read_lines(const std::filesystem::path& mesh,
                                                         const comm::Communicator& comm);

/// @brief The lowest part that has a tet with each edge, by the places of its ends; kNoIndex: none
/// has. @note Collective.
/// @return Shape (num_cells of the lines).
[[nodiscard]] std::vector<LocalIndex> parts_of_lines(const mesh::MeshArrays& lines,
                                                     const migrate::DistributedMesh& mesh,
                                                     const comm::Communicator& comm);

/// @brief The edges that a part has, with its own points. Local.
/// @param[in] tets Of that part, with the array "owner".
[[nodiscard]] mesh::MeshArrays lines_of_part(const mesh::MeshArrays& lines,
                                             const std::vector<LocalIndex>& parts, LocalIndex part,
                                             const mesh::MeshArrays& tets);

}  // namespace tessera::subdomain
