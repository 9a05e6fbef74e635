// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "tessera/base/quadratic_tet.hpp"

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {
namespace {

// New rows of a file's points: own ones first, each kind in the order of the file.
std::vector<LocalIndex> new_rows(const LoadedPiece& loaded, const PieceLinks& links,
                                 LocalIndex num_own)
{
  std::vector<LocalIndex> rows(at(loaded.num_points()), kNoIndex);
  LocalIndex next_foreign = num_own;
  for (std::size_t s = 0; s < links.shared_points.size(); ++s) {
    if (links.shared_numbers[s] != kNoNumber) rows[at(links.shared_points[s])] = next_foreign++;
  }
  LocalIndex next_own = 0;
  for (LocalIndex& row : rows) {
    if (row == kNoIndex) row = next_own++;
  }
  return rows;
}

void add_points(const LoadedPiece& loaded, const PieceLinks& links,
                const std::vector<LocalIndex>& rows, const Outline& outline, Piece& piece)
{
  piece.point_xyz.resize(loaded.point_xyz.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    for (std::size_t d = 0; d < 3; ++d)
      piece.point_xyz[3 * at(rows[p]) + d] = loaded.point_xyz[3 * p + d];
  }
  piece.point_numbers.resize(rows.size());
  for (const PointRun& run : outline.own_points(piece.number))
    for (LocalIndex i = 0; i < run.count; ++i)
      piece.point_numbers[at(run.first_row + i)] = run.first_number + i;
  // Own ones are the first rows, so both kinds of shared points stay ascending.
  for (const bool is_own : {true, false}) {
    for (std::size_t s = 0; s < links.shared_points.size(); ++s) {
      if ((links.shared_numbers[s] == kNoNumber) != is_own) continue;
      const LocalIndex row = rows[at(links.shared_points[s])];
      if (!is_own) piece.point_numbers[at(row)] = links.shared_numbers[s];
      piece.shared_points.push_back(row);
      piece.sharers.add(links.sharers[static_cast<LocalIndex>(s)]);
    }
  }
}

// Takes the points of the tets, which are many.
void move_tets(LoadedPiece& loaded, const Tags& tags, const std::vector<LocalIndex>& rows,
               Piece& piece)
{
  piece.tet_cell = std::move(loaded.tet_cell);
  piece.tet_points = with_nodes(std::move(loaded.tet_points), 4, loaded.tet_nodes, 6);
  for (LocalIndex& point : piece.tet_points) point = rows[at(point)];
  piece.tet_material.reserve(loaded.material.size());
  for (const std::int32_t value : loaded.material)
    piece.tet_material.push_back(tags.tag_of_material.at(value));
}

void add_triangles(const LoadedPiece& loaded, const PieceLinks& links, const Tags& tags,
                   const std::vector<LocalIndex>& rows, Piece& piece)
{
  const bool has_triangles = !loaded.triangle_side.empty();
  piece.triangle_side =
      has_triangles || links.is_inner_triangle.empty() ? loaded.triangle_side : links.open_sides;
  for (std::size_t i = 0; i < piece.triangle_side.size(); ++i) {
    const LocalIndex side = piece.triangle_side[i];
    for (const LocalIndex point : loaded.points_of_side(side))
      piece.triangle_points.push_back(rows[at(point)]);
    piece.triangle_patch.push_back(tags.tag_of_patch.at(has_triangles ? loaded.patch[i] : 0));
  }
  piece.is_inner_triangle = links.is_inner_triangle;
}

void add_lines(const LoadedPiece& loaded, const Tags& tags, const std::vector<LocalIndex>& rows,
               Piece& piece)
{
  for (const LocalIndex point : loaded.line_points) piece.line_points.push_back(rows[at(point)]);
  for (const std::int32_t value : loaded.line) piece.line.push_back(tags.tag_of_line.at(value));
}

void add_patch_points(const std::vector<PatchPoint>& patch_points,
                      const std::vector<LocalIndex>& rows, Piece& piece)
{
  for (const PatchPoint& point : patch_points)
    piece.patch_points.push_back({rows[at(point.point)], point.patch});
  std::ranges::sort(piece.patch_points, [](const PatchPoint& a, const PatchPoint& b) {
    return std::tie(a.patch, a.point) < std::tie(b.patch, b.point);
  });
}

}  // namespace

Piece build_piece(LoadedPiece loaded, LocalIndex number, const PieceLinks& links,
                  const LinkedMesh& mesh)
{
  Piece piece;
  piece.number = number;
  piece.num_own_points = static_cast<LocalIndex>(mesh.outline.pieces[at(number)].num_own_points);
  const std::vector<LocalIndex> rows = new_rows(loaded, links, piece.num_own_points);
  add_points(loaded, links, rows, mesh.outline, piece);
  add_triangles(loaded, links, mesh.tags, rows, piece);
  move_tets(loaded, mesh.tags, rows, piece);
  add_lines(loaded, mesh.tags, rows, piece);
  add_patch_points(links.patch_points, rows, piece);
  piece.seams = links.seams;
  for (const auto& [a, b] : links.shared_edges)
    piece.shared_edges.push_back({rows[at(a)], rows[at(b)]});
  piece.edge_sharers = links.edge_sharers;
  return piece;
}

void for_each_piece(const PieceSource& source, const LinkedMesh& mesh, Rank rank,
                    const std::function<void()>& before_each,
                    const std::function<void(Piece piece, std::size_t row)>& visit)
{
  for (std::size_t i = 0; i < mesh.links.size(); ++i) {
    before_each();
    const LocalIndex number = source.first_of(rank) + static_cast<LocalIndex>(i);
    visit(build_piece(source.load(number), number, mesh.links[i], mesh), i);
  }
}

}  // namespace tessera::formats
