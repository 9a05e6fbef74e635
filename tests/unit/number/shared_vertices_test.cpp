// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/shared_vertices.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::number {
namespace {

constexpr mesh::HostPoint kA{0, 0};
constexpr mesh::HostPoint kB{0, 1};
constexpr mesh::HostPoint kC{7, 0};
constexpr mesh::HostPoint kD{7, 5};

TEST(SharedVertices, AreListedAscending)
{
  mesh::Piece piece;
  piece.vertex_xyz.resize(3 * 4);
  piece.skin_host = {7, 0, 0};
  piece.skin_index = {5, 1, 0};
  EXPECT_EQ(shared_vertices(piece), (std::vector{kA, kB, kD}));
}

TEST(CompareLists, LowestPieceThatHoldsAVertexOwnsIt)
{
  const VertexList own{.subdomain = 4, .material = 1, .vertices = {kA, kB, kC, kD}};
  const std::vector<VertexList> others{{2, 1, {kB}}, {6, 1, {kC, kD}}};
  EXPECT_EQ(compare_lists(own, others).owned, (std::vector{kA, kC, kD}));
}

TEST(CompareLists, EveryVertexHasOneOwner)
{
  const std::vector<VertexList> lists{{0, 1, {kA, kC}}, {1, 1, {kA, kB, kD}}, {2, 1, {kA, kB, kC}}};
  std::vector<mesh::HostPoint> owned;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::vector<VertexList> others = lists;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    for (const mesh::HostPoint& key : compare_lists(lists[i], others).owned) owned.push_back(key);
  }
  std::sort(owned.begin(), owned.end());
  EXPECT_EQ(owned, (std::vector{kA, kB, kC, kD}));
}

TEST(CompareLists, SeamIsWhereTwoPiecesOfOneMaterialMeet)
{
  const VertexList own{.subdomain = 4, .material = 1, .vertices = {kA, kB, kC, kD}};
  // kB: with a piece of its own material. kC: with one of another. kD: with two of another.
  const std::vector<VertexList> others{{2, 1, {kB}}, {6, 2, {kC, kD}}, {7, 2, {kD}}};
  EXPECT_EQ(compare_lists(own, others).on_seam, (std::vector<char>{0, 1, 0, 1}));
}

}  // namespace
}  // namespace tessera::number
