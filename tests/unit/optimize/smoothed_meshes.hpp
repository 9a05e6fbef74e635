// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/optimize/tet_mesh.hpp"

namespace tessera::testing {

/// @brief One entry a vertex: 0 or 1.
using Flags = std::vector<std::uint8_t>;

[[nodiscard]] std::array<std::uint64_t, 3> bits_of(const std::vector<double>& xyz, LocalIndex v);

/// @brief 1 for the vertices of the boundary.
[[nodiscard]] Flags boundary_flags(const optimize::TetMesh& mesh);

/// @brief 1 for all others.
[[nodiscard]] Flags inner_flags(const optimize::TetMesh& mesh);

/// @brief Number of vertices that have moved. A failure of the test if one has that is not flagged.
[[nodiscard]] LocalIndex num_moved(const optimize::TetMesh& mesh, const Flags& may_move,
                                   const std::vector<double>& moved);

/// @brief The mesh pressed along z: its tets become flat.
[[nodiscard]] optimize::TetMesh squeezed(optimize::TetMesh mesh, double height);

/// @brief Some that are good, some that are bad or nearly flat, and children of coarse tets.
[[nodiscard]] std::vector<optimize::TetMesh> positive_meshes();

}  // namespace tessera::testing
