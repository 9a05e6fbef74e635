// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief Pieces of a mesh as read from files: those of this rank.
struct MeshPieces {
  std::vector<mesh::MeshArrays> tets{};
  std::vector<mesh::MeshArrays> boundary{};
  bool has_boundary = false;  ///< There is a boundary file; the same on all ranks.
};

/// @brief Type of the values that a column holds in its 64 bits.
enum class ColumnType : int { int32, int64, float64 };
[[nodiscard]] constexpr ColumnType last_value(ColumnType /*type*/) { return ColumnType::float64; }

/// @brief What a column of MeshBlock::tet_columns means.
struct TetColumn {
  std::string name{};
  ColumnType type = ColumnType::int32;

  static auto fields(auto& self) { return std::tie(self.name, self.type); }

  friend auto operator<=>(const TetColumn&, const TetColumn&) = default;
};

/// @brief A mesh joined from pieces.
struct AssembledMesh {
  DistributedMesh mesh{};
  std::vector<TetColumn> columns{};  ///< Cell arrays that all pieces have, by name; the same on all
                                     ///< ranks.
  std::vector<std::string> notes{};  ///< What was not as a mesh of Tessera has it; on all ranks.
};

/// @brief Joins pieces: finds what vertices they share, and the tets behind boundary triangles.
///
/// Points are matched by id. They are matched by the bits of their positions if a piece has no ids,
/// or if two positions have one id. Ids that are not dense from 0 are replaced: by rank, then in
/// the order of the pieces. Materials are "attribute", or 1. Points that no tet uses are left out.
/// A mesh without a boundary file gets one patch, 0, of all triangles on one tet.
/// @note Collective. For a given number of ranks and pieces on them the result is the same.
/// @throws InputError on all ranks if the pieces do not make up a mesh. Defects are a tet with a
/// corner twice, a triangle on three tets, a boundary triangle without tet, and a triangle on one
/// tet that the boundary file lacks.
[[nodiscard]] AssembledMesh assemble(const comm::Communicator& comm, const MeshPieces& pieces);

}  // namespace tessera::migrate
