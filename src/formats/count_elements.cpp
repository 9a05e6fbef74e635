// SPDX-License-Identifier: BSD-3-Clause
#include "formats/count_elements.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

#include "formats/joined_tets.hpp"

namespace tessera::formats {

std::vector<TagCount> counted(const std::vector<std::int32_t>& values)
{
  std::map<std::int32_t, GlobalIndex> counts;
  for (const std::int32_t value : values) ++counts[value];
  std::vector<TagCount> list;
  for (const auto& [value, count] : counts) list.push_back({value, count});
  return list;
}

ByShape<std::vector<TagCount>> counted_elements(const LoadedPiece& piece)
{
  ByShape<std::vector<std::int32_t>> values;
  const JoinedTets tets(piece);
  for (LocalIndex tet = 0; tet < tets.num_tets();) {
    const CellTets cell = tets_of_cell(tets, tet);
    values[cell.shape()].push_back(piece.material[at(tet)]);
    tet += cell.count;
  }
  for (const JoinedSide& side : joined_sides(tets, piece.triangle_side))
    values[side.shape()].push_back(piece.patch[at(side.row)]);
  values[Shape::line] = piece.line;
  ByShape<std::vector<TagCount>> counts;
  for (const Shape shape : kAllShapes) counts[shape] = counted(values[shape]);
  return counts;
}

std::vector<SideHalves> skin_halves(const LoadedPiece& piece, const std::vector<LocalIndex>& behind)
{
  std::vector<LocalIndex> sides;
  for (std::size_t side = 0; side < behind.size(); ++side)
    if (behind[side] == kNoIndex) sides.push_back(static_cast<LocalIndex>(side));
  std::vector<SideHalves> halves;
  for (const JoinedSide& side : joined_sides(JoinedTets(piece), sides))
    if (side.other_row != kNoIndex)
      halves.push_back({sides[at(side.row)], sides[at(side.other_row)]});
  return halves;
}

void count_open_faces(std::span<const LocalIndex> open_sides, std::span<const SideHalves> halves,
                      PieceCounts& counts)
{
  const auto num_open = static_cast<GlobalIndex>(open_sides.size());
  const GlobalIndex num_quads = std::ranges::count_if(halves, [&](const SideHalves& both) {
    return std::ranges::all_of(
        both, [&](LocalIndex side) { return std::ranges::binary_search(open_sides, side); });
  });
  const auto set = [](GlobalIndex count, std::vector<TagCount>& faces) {
    if (count > 0) faces = {{0, count}};
  };
  set(num_open, counts.outer_triangles_of_patch);
  set(num_open - 2 * num_quads, counts.elements[Shape::triangle]);
  set(num_quads, counts.elements[Shape::quad]);
}

}  // namespace tessera::formats
