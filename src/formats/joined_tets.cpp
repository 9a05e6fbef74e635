// SPDX-License-Identifier: BSD-3-Clause
#include "formats/joined_tets.hpp"

#include <algorithm>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::formats {
namespace {

bool has(std::span<const LocalIndex> points, LocalIndex point)
{
  return std::ranges::find(points, point) != points.end();
}

// The corner of a tet that another one has not.
LocalIndex only_in(const JoinedTets& tets, LocalIndex tet, LocalIndex other)
{
  return *std::ranges::find_if(tets.corners(tet),
                               [&](LocalIndex v) { return !has(tets.corners(other), v); });
}

LocalIndex side_opposite(const JoinedTets& tets, LocalIndex tet, LocalIndex corner)
{
  const auto all = tets.corners(tet);
  return static_cast<LocalIndex>(4 * tet + (std::ranges::find(all, corner) - all.begin()));
}

// Ends of the columns of a prism: p at one of its triangles, q at the other. Its tets go up a stair
// from p0: each has one corner that the one before it lacks, and lacks one corner of that.
struct Columns {
  std::array<LocalIndex, 3> p{};
  std::array<LocalIndex, 3> q{};
};

Columns columns_of(const JoinedTets& tets, LocalIndex first)
{
  const LocalIndex low = first;
  const LocalIndex middle = first + 1;
  const LocalIndex high = first + 2;
  Columns columns;
  columns.p = {tets.corners(low)[0], only_in(tets, middle, high), only_in(tets, low, middle)};
  columns.q = {only_in(tets, high, middle), only_in(tets, middle, low), kNoIndex};
  columns.q[2] =
      *std::ranges::find_if(tets.corners(low), [&](LocalIndex v) { return !has(columns.p, v); });
  return columns;
}

// Sides of the tets of a cell that lie in one side of it, pair by pair.
using Halves = std::array<LocalIndex, 2>;

std::array<Halves, 3> halves_of_prism(const JoinedTets& tets, LocalIndex first)
{
  const auto& [p, q] = columns_of(tets, first);
  const LocalIndex middle = first + 1;
  const LocalIndex high = first + 2;
  return {{{side_opposite(tets, first, p[1]), side_opposite(tets, high, q[1])},
           {side_opposite(tets, middle, q[2]), side_opposite(tets, high, q[2])},
           {side_opposite(tets, first, p[0]), side_opposite(tets, middle, p[0])}}};
}

Halves halves_of_base(LocalIndex first) { return {4 * first, 4 * (first + 1)}; }

std::size_t num_common(const JoinedTets& tets, LocalIndex a, LocalIndex b)
{
  return static_cast<std::size_t>(std::ranges::count_if(
      tets.corners(a), [&](LocalIndex v) { return has(tets.corners(b), v); }));
}

}  // namespace

CellTets tets_of_cell(const JoinedTets& tets, LocalIndex tet)
{
  const LocalIndex cell = tets.cell[at(tet)];
  LocalIndex first = tet;
  while (first > 0 && tets.cell[at(first - 1)] == cell) --first;
  LocalIndex end = tet + 1;
  while (end < tets.num_tets() && tets.cell[at(end)] == cell) ++end;
  return {first, end - first};
}

std::array<LocalIndex, 6> prism_corners(const JoinedTets& tets, LocalIndex first)
{
  auto [p, q] = columns_of(tets, first);
  const auto low = tets.corners(first);
  const auto place = std::ranges::find(low, p[1]) - low.begin();
  const LocalIndex next = low[static_cast<std::size_t>(place % 3 + 1)];
  if (next != p[2]) {  // The first triangle points away from the other one.
    std::swap(p[1], p[2]);
    std::swap(q[1], q[2]);
  }
  return {p[0], p[1], p[2], q[0], q[1], q[2]};
}

std::array<LocalIndex, 5> pyramid_corners(const JoinedTets& tets, LocalIndex first)
{
  const auto [half, other] = halves_of_base(first);
  auto base = quad_of(triangle_of_side(tets, half), triangle_of_side(tets, other));
  std::swap(base[1], base[3]);
  return {base[0], base[1], base[2], base[3], tets.corners(first)[0]};
}

const char* defect_of_cell(const JoinedTets& tets, const CellTets& cell)
{
  for (LocalIndex tet = cell.first; tet + 1 < cell.first + cell.count; ++tet) {
    if (num_common(tets, tet, tet + 1) != 3) return "its tets do not meet in triangles";
    if (tets.corners(tet)[0] != tets.corners(tet + 1)[0])
      return "its tets begin with several points";
  }
  const bool is_stair = cell.count < 3 || num_common(tets, cell.first, cell.first + 2) == 2;
  return is_stair ? "" : "its tets are no stair";
}

LocalIndex other_half(const JoinedTets& tets, LocalIndex side)
{
  const auto partner = [&](const Halves& halves) {
    if (side == halves[0]) return halves[1];
    return side == halves[1] ? halves[0] : kNoIndex;
  };
  const CellTets cell = tets_of_cell(tets, side / 4);
  if (cell.shape() == Shape::pyramid) return partner(halves_of_base(cell.first));
  if (cell.shape() != Shape::prism) return kNoIndex;
  for (const Halves& halves : halves_of_prism(tets, cell.first))
    if (partner(halves) != kNoIndex) return partner(halves);
  return kNoIndex;
}

std::vector<JoinedSide> joined_sides(const JoinedTets& tets, std::span<const LocalIndex> sides)
{
  std::vector<LocalIndex> rows_by_side;
  if (tets.has_prisms()) {
    rows_by_side.resize(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) rows_by_side[i] = static_cast<LocalIndex>(i);
    std::ranges::sort(rows_by_side, {}, [&](LocalIndex row) { return sides[at(row)]; });
  }
  std::vector<JoinedSide> joined;
  joined.reserve(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    JoinedSide side{.row = static_cast<LocalIndex>(i)};
    const LocalIndex half = rows_by_side.empty() ? kNoIndex : other_half(tets, sides[i]);
    const auto found = std::ranges::lower_bound(rows_by_side, half, {},
                                                [&](LocalIndex row) { return sides[at(row)]; });
    if (half != kNoIndex && found != rows_by_side.end() && sides[at(*found)] == half) {
      if (half < sides[i]) continue;  // It went with the other half.
      side.other_row = *found;
    }
    joined.push_back(side);
  }
  return joined;
}

std::vector<LocalIndex> corners_of(const JoinedTets& tets, std::span<const LocalIndex> sides,
                                   const JoinedSide& side)
{
  const auto triangle = triangle_of_side(tets, sides[at(side.row)]);
  if (side.shape() == Shape::triangle) return {triangle.begin(), triangle.end()};
  const auto quad = quad_of(triangle, triangle_of_side(tets, sides[at(side.other_row)]));
  return {quad.begin(), quad.end()};
}

std::array<LocalIndex, 3> triangle_of_side(const JoinedTets& tets, LocalIndex side)
{
  const auto& [a, b, c] = mesh::kTetFaceCorners[at(side % 4)];
  const auto corners = tets.corners(side / 4);
  return {corners[a], corners[b], corners[c]};
}

std::array<LocalIndex, 4> quad_of(const std::array<LocalIndex, 3>& a,
                                  const std::array<LocalIndex, 3>& b)
{
  const LocalIndex apex = *std::ranges::find_if(b, [&](LocalIndex v) { return !has(a, v); });
  std::array<LocalIndex, 4> quad{};
  std::size_t to = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    quad[to++] = a[i];
    if (has(b, a[i]) && has(b, a[(i + 1) % 3])) quad[to++] = apex;
  }
  return quad;
}

}  // namespace tessera::formats
