// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessera/formats/piece.hpp"

/// The faces of a piece in OpenFOAM's order. A face is a side of a tet (4 * tet + opposite corner),
/// and is seen from outside of this tet, which is its owner.
namespace tessera::formats {

/// @brief A face and the tet on its other side.
struct FoamFace {
  LocalIndex side = 0;
  GlobalIndex neighbour = 0;  ///< Number in the whole mesh, above the owner's.
};

/// @brief Faces between two tets of which the lower one is in the piece, by owner and then by
/// neighbour; the neighbour may be in a later piece. Local; linear in time.
/// @param[in] first_tet Number of the piece's first tet in the whole mesh.
[[nodiscard]] std::vector<FoamFace> foam_inner_faces(const Piece& piece, GlobalIndex first_tet);

/// @brief Faces to another piece, in an order that both pieces find. Local.
[[nodiscard]] std::vector<LocalIndex> foam_seam_faces(const Piece& piece, GlobalIndex first_tet,
                                                      LocalIndex other_piece);

/// @brief Faces of a patch with no second tet; of kNoPatchTag those that no triangle stands for.
/// Local.
[[nodiscard]] std::vector<LocalIndex> foam_patch_faces(const Piece& piece, std::int32_t tag);
inline constexpr std::int32_t kNoPatchTag = 0;

/// @brief Rows of a face's points, from the one with the lowest number on: so two pieces begin with
/// the same point. Local.
[[nodiscard]] std::array<LocalIndex, 3> foam_face_points(const Piece& piece, LocalIndex side);

/// @brief Tets of each material, as numbers. Local.
/// @param[in] first_tet Number of the piece's first tet.
[[nodiscard]] std::vector<std::vector<std::int32_t>> foam_zone_tets(const Piece& piece,
                                                                    std::size_t num_materials,
                                                                    GlobalIndex first_tet);

}  // namespace tessera::formats
