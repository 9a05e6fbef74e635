// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/vec3.hpp"
#include "tessera/check/check_mesh.hpp"
#include "tessera/comm/all_or_none.hpp"

namespace tessera::check {
namespace {

constexpr std::size_t kMostOffenders = 10;

using Ends = std::array<Vec3, 2>;  // Ascending.

Ends ends_of(const mesh::MeshArrays& cells, LocalIndex a, LocalIndex b)
{
  const std::span<const double> xyz(cells.point_xyz);
  const Vec3 p = point_at(xyz, a);
  const Vec3 q = point_at(xyz, b);
  return {std::min(p, q), std::max(p, q)};
}

// Between points that lines have, so few.
std::set<Ends> edges_of_tets(const mesh::MeshArrays& tets, const std::set<Vec3>& points)
{
  const auto width = static_cast<std::size_t>(tets.vertices_per_cell);
  std::set<Ends> edges;
  if (width != 4 && width != 10) return edges;  // Not even tets.
  std::vector<bool> is_on_line;
  for (std::size_t p = 0; 3 * p < tets.point_xyz.size(); ++p) {
    is_on_line.push_back(
        points.contains(point_at(std::span(tets.point_xyz), static_cast<LocalIndex>(p))));
  }
  for (std::size_t first = 0; first < tets.cell_points.size(); first += width) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const LocalIndex a = tets.cell_points[first + i];
        const LocalIndex b = tets.cell_points[first + j];
        if (is_on_line[at(a)] && is_on_line[at(b)]) edges.insert(ends_of(tets, a, b));
      }
    }
  }
  return edges;
}

// What is wrong with the edges of one piece, a text each.
std::vector<std::string> lost_edges(const mesh::MeshArrays& tets, const mesh::MeshArrays& lines,
                                    LocalIndex piece)
{
  const auto width = static_cast<std::size_t>(lines.vertices_per_cell);
  std::set<Vec3> points;
  for (std::size_t p = 0; 3 * p < lines.point_xyz.size(); ++p)
    points.insert(point_at(std::span(lines.point_xyz), static_cast<LocalIndex>(p)));
  const std::set<Ends> edges = edges_of_tets(tets, points);
  std::vector<std::string> lost;
  for (std::size_t e = 0; e * width < lines.cell_points.size(); ++e) {
    const Ends ends =
        ends_of(lines, lines.cell_points[e * width], lines.cell_points[e * width + 1]);
    if (edges.contains(ends)) continue;
    lost.push_back(
        fmt::format("piece {}, edge {} of the lines, from ({:g}) to ({:g}): no tet has it", piece,
                    e, fmt::join(ends[0], ", "), fmt::join(ends[1], ", ")));
  }
  return lost;
}

}  // namespace

void check_lines(const PieceSource& tets, const PieceSource& lines,
                 const std::vector<LocalIndex>& piece_of_lines, const comm::Communicator& comm,
                 CheckReport& report)
{
  std::vector<std::string> own;
  comm::all_or_none(comm, [&] {
    for (LocalIndex p = comm.rank(); p < lines.num_pieces; p += comm.size()) {
      const LocalIndex piece = piece_of_lines[at(p)];
      const std::vector<std::string> lost = lost_edges(tets.read(piece), lines.read(p), piece);
      own.insert(own.end(), lost.begin(), lost.end());
    }
  });
  Defect defect{.kind = "line_edge"};
  for (const std::vector<std::string>& lost : comm.all_gather_values(own)) {
    defect.count += static_cast<GlobalIndex>(lost.size());
    defect.offenders.insert(defect.offenders.end(), lost.begin(), lost.end());
  }
  if (defect.count == 0) return;
  std::ranges::sort(defect.offenders);
  defect.offenders.resize(std::min(defect.offenders.size(), kMostOffenders));
  report.defects.push_back(std::move(defect));
  report.conforms = false;
}

}  // namespace tessera::check
