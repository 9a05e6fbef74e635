// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/half_edges.hpp"

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

using Rows = std::vector<LocalIndex>;

// Of a tet, seen from outside.
const Rows kTetFaces{1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1};

Rows list_of(const IndexLists& lists, LocalIndex i) { return {lists[i].begin(), lists[i].end()}; }

TEST(NextInTriangle, GoesRoundTheTriangle)
{
  for (const LocalIndex first : {0, 3, 300}) {
    EXPECT_EQ(next_in_triangle(first), first + 1);
    EXPECT_EQ(next_in_triangle(first + 1), first + 2);
    EXPECT_EQ(next_in_triangle(first + 2), first);
  }
}

TEST(HalfEdgesOfEdges, AreInTheOrderOfVertices)
{
  const IndexLists edges = half_edges_of_edges(kTetFaces);
  ASSERT_EQ(edges.num_lists(), 6);
  EXPECT_EQ(list_of(edges, 0), (Rows{6, 11}));  // Of 0 and 1.
  EXPECT_EQ(list_of(edges, 1), (Rows{5, 9}));   // Of 0 and 2.
  EXPECT_EQ(list_of(edges, 2), (Rows{3, 8}));   // Of 0 and 3.
  EXPECT_EQ(list_of(edges, 3), (Rows{0, 10}));  // Of 1 and 2.
  EXPECT_EQ(list_of(edges, 4), (Rows{2, 7}));   // Of 1 and 3.
  EXPECT_EQ(list_of(edges, 5), (Rows{1, 4}));   // Of 2 and 3.
}

TEST(HalfEdgesOfEdges, AreOneOrManyWhereTrianglesEndOrMeet)
{
  const IndexLists edges = half_edges_of_edges(Rows{5, 7, 9, 7, 5, 8, 5, 7, 6});
  ASSERT_EQ(edges.num_lists(), 7);
  EXPECT_EQ(list_of(edges, 0), Rows{8});          // Of 5 and 6.
  EXPECT_EQ(list_of(edges, 1), (Rows{0, 3, 6}));  // Of 5 and 7.
  EXPECT_EQ(edges.values.size(), 9U);
}

TEST(HalfEdgesOfEdges, OfNoTriangleAreNone) { EXPECT_EQ(half_edges_of_edges({}).num_lists(), 0); }

TEST(OppositeHalfEdges, RunTheOtherWayAlongTheSameEdge)
{
  const Rows opposite = opposite_half_edges(half_edges_of_edges(kTetFaces));
  ASSERT_EQ(opposite.size(), kTetFaces.size());
  for (LocalIndex h = 0; h < 12; ++h) {
    const LocalIndex other = opposite[at(h)];
    EXPECT_EQ(opposite[at(other)], h);
    EXPECT_EQ(kTetFaces[at(other)], kTetFaces[at(next_in_triangle(h))]);
    EXPECT_EQ(kTetFaces[at(next_in_triangle(other))], kTetFaces[at(h)]);
  }
}

}  // namespace
}  // namespace tessera::mesh
