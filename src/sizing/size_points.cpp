// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/sizing/coarse_sizes.hpp"

namespace tessera::sizing {
namespace {

constexpr int kMostCuts = 10;
constexpr std::size_t kMostCells = 4'000'000;

// A coarse tet or a part of it.
struct Cell {
  std::array<Vec3, 4> corners{};
  double longest_part = 0.0;  // Of the tet's edges, when each is split on its levels.

  [[nodiscard]] Vec3 middle() const
  {
    return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  }
};

double radius_of(const Cell& cell, const Vec3& middle)
{
  double radius = 0.0;
  for (const Vec3& corner : cell.corners) radius = std::max(radius, norm(corner - middle));
  return radius;
}

void append_children(const Cell& cell, std::vector<Cell>& cells)
{
  const auto at = [&](const mesh::lattice::TetPoint& p) {
    const std::array<LocalIndex, 4> weights{2 - p.i - p.j - p.k, p.i, p.j, p.k};
    Vec3 point{};
    for (std::size_t c = 0; c < 4; ++c) point = point + (0.5 * weights[c]) * cell.corners[c];
    return point;
  };
  mesh::lattice::for_each_child(
      2, 1, 0, [&](const auto& a, const auto& b, const auto& c, const auto& d) {
        cells.push_back({{at(a), at(b), at(c), at(d)}, cell.longest_part});
      });
}

double longest_part(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels, LocalIndex t)
{
  const auto tet = coarse.tet(t);
  double longest = 0.0;
  for (const auto& [a, b] : mesh::kTetEdgeCorners) {
    const double length = norm(coarse.position(tet[b]) - coarse.position(tet[a]));
    longest = std::max(longest, std::ldexp(length, -levels.of(tet[a], tet[b])));
  }
  return longest;
}

std::vector<Cell> cells_of(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels)
{
  std::vector<Cell> cells;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    cells.push_back({corners_at<4>(coarse.vertex_xyz, coarse.tet_vertices, t),
                     longest_part(coarse, levels, t)});
  }
  return cells;
}

std::vector<double> sizes_in_the_middle(const std::vector<Cell>& cells, const SizeField& sizes)
{
  std::vector<double> middles;
  middles.reserve(3 * cells.size());
  for (const Cell& cell : cells) {
    const Vec3 middle = cell.middle();
    middles.insert(middles.end(), middle.begin(), middle.end());
  }
  return sizes.at(middles);
}

// A tet or a part of it, with the size in its middle.
struct Visited {
  const Cell& cell;
  Vec3 middle{};
  double size = 0.0;
  int num_cuts = 0;  // That have made it of a tet.
  bool is_cut = false;
};

// In bulk rounds, until no part is longer than `coarse_edge` sizes anywhere in it.
template <class Visit>
void for_each_cell(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels,
                   const SizeField& sizes, double coarse_edge, const Visit& visit)
{
  std::vector<Cell> cells = cells_of(coarse, levels);
  for (int num_cuts = 0; !cells.empty(); ++num_cuts) {
    const std::vector<double> in_the_middle = sizes_in_the_middle(cells, sizes);
    std::vector<Cell> smaller;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Vec3 middle = cells[i].middle();
      const double reach = sizes.steepest() * radius_of(cells[i], middle);
      const double least = std::max(0.0, in_the_middle[i] - reach);
      const bool is_cut = mesh::longest_edge(cells[i].corners) > coarse_edge * least
                          && num_cuts < kMostCuts && smaller.size() < kMostCells;
      visit(Visited{cells[i], middle, in_the_middle[i], num_cuts, is_cut});
      if (is_cut) append_children(cells[i], smaller);
    }
    cells = std::move(smaller);
  }
}

}  // namespace

mesh::SizePoints coarse_size_points(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels,
                                    const SizeField& sizes, const EdgeLengths& in_sizes)
{
  mesh::SizePoints points;
  bool is_needed = false;
  for_each_cell(coarse, levels, sizes, in_sizes.coarse_edge, [&](const Visited& at) {
    is_needed = is_needed || at.cell.longest_part > in_sizes.longest_part * at.size;
    if (at.is_cut || at.num_cuts == 0) return;
    points.xyz.insert(points.xyz.end(), at.middle.begin(), at.middle.end());
    points.size.push_back(in_sizes.coarse_edge * at.size);
  });
  return is_needed ? points : mesh::SizePoints{};
}

PartInSizes longest_part_in_sizes(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels,
                                  const SizeField& sizes, double coarse_edge)
{
  PartInSizes longest;
  for_each_cell(coarse, levels, sizes, coarse_edge, [&](const Visited& at) {
    if (at.cell.longest_part <= longest.in_sizes * at.size) return;
    longest = {at.cell.longest_part / at.size, at.size, at.middle};
  });
  return longest;
}

}  // namespace tessera::sizing
