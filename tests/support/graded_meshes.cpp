// SPDX-License-Identifier: BSD-3-Clause
#include "support/graded_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/refine/choose_levels.hpp"

namespace tessera::testing {
namespace {

std::vector<LocalIndex> random_order(LocalIndex size, std::mt19937& random)
{
  std::vector<LocalIndex> order(at(size));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, random);
  return order;
}

// Any of the twelve orders that keep the orientation.
std::array<LocalIndex, 4> turned(std::array<LocalIndex, 4> tet, std::mt19937& random)
{
  const auto times = random() % 12;
  for (std::uint32_t i = 0; i < times; ++i) {
    if (i % 3 == 2) {
      std::swap(tet[0], tet[3]);
      std::swap(tet[1], tet[2]);
    } else {
      std::rotate(tet.begin(), tet.begin() + 1, tet.begin() + 3);
    }
  }
  return tet;
}

}  // namespace

mesh::CoarseMesh shuffled(const mesh::CoarseMesh& coarse, std::uint32_t seed)
{
  std::mt19937 random(seed);
  mesh::CoarseMesh mesh = coarse;
  const auto number = random_order(coarse.num_vertices(), random);
  for (LocalIndex v = 0; v < coarse.num_vertices(); ++v) {
    std::ranges::copy(coarse.position(v), &mesh.vertex_xyz[3 * at(number[at(v)])]);
  }
  for (auto* const list : {&mesh.face_vertices, &mesh.segment_vertices}) {
    for (LocalIndex& v : *list) v = number[at(v)];
  }
  mesh.tet_vertices.clear();
  mesh.tet_material.clear();
  for (const LocalIndex t : random_order(coarse.num_tets(), random)) {
    const auto old = coarse.tet(t);
    const auto tet = turned(
        {number[at(old[0])], number[at(old[1])], number[at(old[2])], number[at(old[3])]}, random);
    mesh.tet_vertices.insert(mesh.tet_vertices.end(), tet.begin(), tet.end());
    mesh.tet_material.push_back(coarse.tet_material[at(t)]);
  }
  return mesh;
}

mesh::EdgeLevels random_levels(const mesh::CoarseMesh& coarse, int most, double share,
                               std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::vector<LocalIndex> edges = mesh::coarse_edges(coarse);
  std::vector<double> num_wanted(edges.size() / 2);
  for (double& wanted : num_wanted) {
    const bool is_above = static_cast<double>(random() % 1000) < 1000.0 * share;
    const auto level = is_above ? 1 + static_cast<int>(random() % at(most)) : 0;
    wanted = std::ldexp(1.0, level);
  }
  return refine::choose_levels(coarse, std::move(edges), num_wanted, most);
}

}  // namespace tessera::testing
