// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/formats/piece.hpp"

#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief How often each value is there, ascending. Local.
[[nodiscard]] std::vector<TagCount> counted(const std::vector<std::int32_t>& values);

/// @brief PieceCounts::elements, by the values in files. Local.
[[nodiscard]] ByShape<std::vector<TagCount>> counted_elements(const LoadedPiece& piece);

/// @brief Two sides of tets that are one side of a cell.
using SideHalves = std::array<LocalIndex, 2>;

/// @brief Those of the sides that have no second tet in the piece. Local.
/// @param[in] behind Of tets_behind().
[[nodiscard]] std::vector<SideHalves> skin_halves(const LoadedPiece& piece,
                                                  const std::vector<LocalIndex>& behind);

/// @brief Counts faces where files do not say which there are: those with no second cell anywhere,
/// which get the patch 0. Local.
/// @param[in] open_sides Ascending.
void count_open_faces(std::span<const LocalIndex> open_sides, std::span<const SideHalves> halves,
                      PieceCounts& counts);

}  // namespace tessera::formats
