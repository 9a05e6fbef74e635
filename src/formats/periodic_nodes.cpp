// SPDX-License-Identifier: BSD-3-Clause
#include "formats/periodic_nodes.hpp"

#include <cstdint>

namespace tessera::formats {

void for_each_periodic(const Outline& outline, const Piece& piece, const VisitPeriodic& visit)
{
  for (std::size_t row = 0; row < outline.periodic.size(); ++row) {
    const auto found = rows_of_patch(piece.periodic_points, static_cast<std::int32_t>(row));
    if (!found.empty()) visit(row, outline.periodic[row].first_point[at(piece.number)], found);
  }
}

std::array<GlobalIndex, 2> periodic_nodes(const Piece& piece, const PeriodicPoint& point)
{
  return {piece.point_numbers[at(point.point)] + 1, point.of_number + 1};
}

}  // namespace tessera::formats
