// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/sizing/coarse_sizes.hpp"

namespace tessera::sizing {
namespace {

constexpr int kMostCuts = 10;
constexpr std::size_t kMostCells = 4'000'000;

using Cell = std::array<Vec3, 4>;

Vec3 middle_of(const Cell& cell) { return 0.25 * (cell[0] + cell[1] + cell[2] + cell[3]); }

double longest_edge(const Cell& cell)
{
  double longest = 0.0;
  for (const auto& [a, b] : mesh::kTetEdgeCorners) {
    longest = std::max(longest, norm(cell[b] - cell[a]));
  }
  return longest;
}

double radius_of(const Cell& cell, const Vec3& middle)
{
  double radius = 0.0;
  for (const Vec3& corner : cell) radius = std::max(radius, norm(corner - middle));
  return radius;
}

void append_children(const Cell& cell, std::vector<Cell>& cells)
{
  const auto at = [&](const mesh::lattice::TetPoint& p) {
    const std::array<LocalIndex, 4> weights{2 - p.i - p.j - p.k, p.i, p.j, p.k};
    Vec3 point{};
    for (std::size_t c = 0; c < 4; ++c) point = point + (0.5 * weights[c]) * cell[c];
    return point;
  };
  mesh::lattice::for_each_child(2, 1, 0,
                                [&](const auto& a, const auto& b, const auto& c, const auto& d) {
                                  cells.push_back({at(a), at(b), at(c), at(d)});
                                });
}

std::vector<Cell> cells_of(const mesh::CoarseMesh& coarse)
{
  std::vector<Cell> cells;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    const auto v = coarse.tet(t);
    cells.push_back({coarse.position(v[0]), coarse.position(v[1]), coarse.position(v[2]),
                     coarse.position(v[3])});
  }
  return cells;
}

std::vector<double> sizes_in_the_middle(const std::vector<Cell>& cells, const SizeField& sizes)
{
  std::vector<double> middles;
  middles.reserve(3 * cells.size());
  for (const Cell& cell : cells) {
    const Vec3 middle = middle_of(cell);
    middles.insert(middles.end(), middle.begin(), middle.end());
  }
  return sizes.at(middles);
}

}  // namespace

mesh::SizePoints coarse_size_points(const mesh::CoarseMesh& coarse, const SizeField& sizes,
                                    double factor)
{
  mesh::SizePoints points;
  std::vector<Cell> cells = cells_of(coarse);
  for (int num_cuts = 0; !cells.empty(); ++num_cuts) {
    const std::vector<double> in_the_middle = sizes_in_the_middle(cells, sizes);
    std::vector<Cell> smaller;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Vec3 middle = middle_of(cells[i]);
      const double reach = sizes.steepest() * radius_of(cells[i], middle);
      const bool may_be_too_long =
          longest_edge(cells[i]) > factor * std::max(0.0, in_the_middle[i] - reach);
      if (may_be_too_long && num_cuts < kMostCuts && smaller.size() < kMostCells) {
        append_children(cells[i], smaller);
      } else if (num_cuts > 0) {
        points.xyz.insert(points.xyz.end(), middle.begin(), middle.end());
        points.size.push_back(factor * in_the_middle[i]);
      }
    }
    cells = std::move(smaller);
  }
  return points;
}

}  // namespace tessera::sizing
