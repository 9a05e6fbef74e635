// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/sorted_rows.hpp"

#include <array>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

using Row = std::array<LocalIndex, 2>;
using Rows = std::vector<Row>;

Rows sorted(Rows rows)
{
  sort_by_smallest(
      rows, [](const Row& row) { return row[0]; }, std::less<>{});
  return rows;
}

TEST(SortBySmallest, SortsAndKeepsRowsThatStandTwice)
{
  EXPECT_EQ(sorted({{5, 6}, {0, 9}, {5, 6}, {2, 4}, {0, 1}, {2, 3}}),
            (Rows{{0, 1}, {0, 9}, {2, 3}, {2, 4}, {5, 6}, {5, 6}}));
  EXPECT_EQ(sorted({}), Rows());
  EXPECT_EQ(sorted({{7, 8}}), (Rows{{7, 8}}));
}

TEST(NumberRows, HasEachRowOnceAndSaysWhichEachGivenOneIs)
{
  const Rows given{{4, 5}, {0, 3}, {4, 5}, {0, 1}, {9, 10}, {0, 3}};
  const NumberedRows<2> numbered = number_rows(given);
  EXPECT_EQ(numbered.rows, (Rows{{0, 1}, {0, 3}, {4, 5}, {9, 10}}));
  EXPECT_EQ(numbered.row_of, (std::vector<LocalIndex>{2, 1, 2, 0, 3, 1}));
  EXPECT_TRUE(number_rows(Rows()).rows.empty());
}

TEST(NumberRows, TellsRowsOfThreeApartByEachVertex)
{
  const std::vector<std::array<LocalIndex, 3>> given{{1, 5, 7}, {1, 4, 9}, {1, 5, 6}, {0, 5, 6}};
  const NumberedRows<3> numbered = number_rows(given);
  EXPECT_EQ(numbered.rows, (std::vector{given[3], given[1], given[2], given[0]}));
  EXPECT_EQ(numbered.row_of, (std::vector<LocalIndex>{3, 1, 2, 0}));
}

TEST(FindRow, IsNoneForWhatIsNotThere)
{
  const std::vector<LocalIndex> flat{1, 2, 4, 1, 3, 3, 2, 0, 0};
  EXPECT_EQ((find_row<3>(flat, {1, 2, 4})), 0);
  EXPECT_EQ((find_row<3>(flat, {1, 3, 3})), 1);
  EXPECT_EQ((find_row<3>(flat, {2, 0, 0})), 2);
  EXPECT_EQ((find_row<3>(flat, {0, 9, 9})), kNoIndex);  // Before the first.
  EXPECT_EQ((find_row<3>(flat, {1, 2, 5})), kNoIndex);
  EXPECT_EQ((find_row<3>(flat, {2, 0, 1})), kNoIndex);  // After the last.
  EXPECT_EQ((find_row<3>({}, {0, 0, 0})), kNoIndex);
}

TEST(FindEdgeRow, TakesEndsInAnyOrder)
{
  const std::vector<LocalIndex> edges{0, 1, 0, 7, 3, 4};
  EXPECT_EQ(find_edge_row(edges, 7, 0), 1);
  EXPECT_EQ(find_edge_row(edges, 0, 7), 1);
  EXPECT_EQ(find_edge_row(edges, 1, 7), kNoIndex);
}

}  // namespace
}  // namespace tessera::mesh
