// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/entity_key.hpp"
#include "tessera/comm/communicator.hpp"

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {

/// @brief Adds the corners of a triangle on a patch to `points`. Local.
void add_patch_points(std::span<const LocalIndex> corners, std::int32_t patch,
                      std::vector<PatchPoint>& points);

/// @brief Leaves each point on a patch with one piece: the lowest that has a triangle of the patch
/// on it. Solvers add loads for a point that is listed twice.
/// @note Collective.
/// @param[in,out] links Of this rank's pieces; their patch points have the values of files, in any
/// order and repeated. Afterwards they have tags, ascend by tag and row, and none stands twice.
/// @param[in] keys Of the shared points, piece after piece.
/// @param[in] first Number of the first piece.
void share_out_patch_points(std::vector<PieceLinks>& links, std::span<const VertexKey> keys,
                            const Tags& tags, LocalIndex first, const comm::Communicator& comm);

}  // namespace tessera::formats
