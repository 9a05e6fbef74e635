// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tessera/formats/piece.hpp"

/// The nodes of periodic patches as files list them: pair by pair.
namespace tessera::formats {

/// @brief Those of a patch, of rows that ascend by patch. Local.
template <class Row>
[[nodiscard]] std::span<const Row> rows_of_patch(const std::vector<Row>& rows, std::int32_t patch)
{
  return {std::ranges::lower_bound(rows, patch, {}, &Row::patch),
          std::ranges::upper_bound(rows, patch, {}, &Row::patch)};
}

/// @brief Called with a row of Outline::periodic, how many of its points are in pieces before, and
/// the points that this piece has of it: at least one.
using VisitPeriodic =
    std::function<void(std::size_t row, GlobalIndex first, std::span<const PeriodicPoint> points)>;

/// @brief Visits what a piece has, row by row. Local.
void for_each_periodic(const Outline& outline, const Piece& piece, const VisitPeriodic& visit);

/// @brief Numbers from 1 of an image and of the point whose image it is. Local.
[[nodiscard]] std::array<GlobalIndex, 2> periodic_nodes(const Piece& piece,
                                                        const PeriodicPoint& point);

}  // namespace tessera::formats
