// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_grading.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/tet_children.hpp"

namespace tessera::mesh {
namespace {

std::size_t shortest_diagonal(const std::array<Vec3, 4>& corners)
{
  std::size_t shortest = 0;
  double least = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const Vec3 diagonal = midpoint(corners[0], corners[d + 1])
                          - midpoint(corners[1 + (d + 1) % 3], corners[1 + (d + 2) % 3]);
    const double length = dot(diagonal, diagonal);
    if (d > 0 && length >= least) continue;
    least = length;
    shortest = d;
  }
  return shortest;
}

TetEdgeOrder order_of_edges(const std::array<Vec3, 4>& corners,
                            const std::array<LocalIndex, 4>& vertices)
{
  std::array<EdgeRank, 6> ranks;
  for (std::size_t e = 0; e < ranks.size(); ++e) {
    const auto [a, b] = kTetEdgeCorners[e];
    ranks[e] = edge_rank({vertices[a], vertices[b]}, {corners[a], corners[b]});
  }
  TetEdgeOrder order{};
  for (std::size_t e = 0; e < ranks.size(); ++e) {
    order[e] = static_cast<std::uint8_t>(
        std::ranges::count_if(ranks, [&](const EdgeRank& other) { return other < ranks[e]; }));
  }
  return order;
}

// Bit s: points of one level more are on what the corners s span.
std::uint16_t finer_supports(unsigned finer)
{
  unsigned supports = 0;
  for (std::size_t e = 0; e < kTetEdgeCorners.size(); ++e) {
    const auto [a, b] = kTetEdgeCorners[e];
    if ((finer >> e & 1U) != 0) supports |= 1U << (1U << a | 1U << b);
  }
  for (const auto& [a, b, c] : kTetFaceCorners) {
    const auto is_finer = [&](std::size_t p, std::size_t q) {
      return (supports >> (1U << p | 1U << q) & 1U) != 0;
    };
    if (is_finer(a, b) && is_finer(b, c) && is_finer(a, c)) {
      supports |= 1U << (1U << a | 1U << b | 1U << c);
    }
  }
  return static_cast<std::uint16_t>(supports);
}

bool has_finer_face(const TetGrading& grading)
{
  return std::ranges::any_of(kTetFaceCorners, [&](const auto& face) {
    return grading.is_finer_on(1U << face[0] | 1U << face[1] | 1U << face[2]);
  });
}

// One by one, with two intervals.
GlobalIndex count_on_one_level(TetGrading grading)
{
  grading.level = 1;
  GlobalIndex count = 0;
  for_each_graded_child(
      grading, [](const ChildCorners& /*child*/) { return DiagonalLengths{}; },
      [&](const auto&... /*corners*/) { ++count; });
  return count;
}

}  // namespace

Vec3 rank_position(const CoarseMesh& coarse, LocalIndex v)
{
  return coarse.layers.are_none() ? coarse.position(v) : coarse.layers.wall(v);
}

std::array<Vec3, 2> rank_positions(const RefinedLattice& lattice, LocalIndex e)
{
  const RefinedLattice& ranked = lattice.walls == nullptr ? lattice : *lattice.walls;
  return {ranked.edge_point(e, 0), ranked.edge_point(e, ranked.edge_intervals(e))};
}

EdgeRank edge_rank(std::array<LocalIndex, 2> v, std::array<Vec3, 2> xyz)
{
  if (v[1] < v[0]) {
    std::swap(v[0], v[1]);
    std::swap(xyz[0], xyz[1]);
  }
  const Vec3 edge = xyz[1] - xyz[0];
  return {dot(edge, edge), v};
}

TetGrading TetGrading::of(const std::array<Vec3, 4>& corners, const std::array<Vec3, 4>& ranked,
                          const std::array<LocalIndex, 4>& vertices,
                          const std::array<int, 6>& levels)
{
  TetGrading grading;
  grading.level = *std::ranges::min_element(levels);
  grading.diagonal = shortest_diagonal(corners);
  for (std::size_t e = 0; e < levels.size(); ++e) {
    if (levels[e] > grading.level) grading.finer |= 1U << e;
  }
  if (grading.is_uniform()) return grading;
  grading.order = order_of_edges(ranked, vertices);
  grading.finer_supports_ = finer_supports(grading.finer);
  return grading;
}

TetGrading tet_grading(const CoarseMesh& coarse, const EdgeLevels& levels, LocalIndex tet)
{
  const auto v = coarse.tet(tet);
  std::array<int, 6> of_edges{};
  for (std::size_t e = 0; e < of_edges.size(); ++e) {
    const auto [a, b] = kTetEdgeCorners[e];
    of_edges[e] = levels.of(v[a], v[b]);
  }
  std::array<Vec3, 4> corners{};
  std::array<Vec3, 4> ranked{};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    corners[c] = coarse.position(v[c]);
    ranked[c] = rank_position(coarse, v[c]);
  }
  return TetGrading::of(corners, ranked, {v[0], v[1], v[2], v[3]}, of_edges);
}

// A finer face alone: each of its n^2 triangles makes four tets of one, and each of its n (n-1)/2
// triangles upside down has two edges on tets that show the face no more than that edge. A finer
// edge elsewhere cuts n tets in two. What is left depends on how corners are cut.
GlobalIndex num_children(const TetGrading& grading)
{
  const GlobalIndex n = grading.intervals();
  const GlobalIndex all = n * n * n;
  const int num_finer = std::popcount(grading.finer);
  if (!has_finer_face(grading) && n > 1) return all + num_finer * n;
  if (n == 1) return static_cast<GlobalIndex>(cut_tet(grading.finer, grading.order, {}).size());
  if (num_finer == 3) return all + 4 * n * n - n;
  if (num_finer == 4) {
    const auto corner = static_cast<GlobalIndex>(cut_tet(grading.finer, grading.order, {}).size());
    return all + 4 * n * n + corner - 5;
  }
  constexpr GlobalIndex kFewest = 36;  // With five finer edges and two intervals.
  return all + 8 * n * n - 2 * n + (count_on_one_level(grading) - kFewest) * (n - 1);
}

}  // namespace tessera::mesh
