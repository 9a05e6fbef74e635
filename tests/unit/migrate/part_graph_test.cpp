// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/partition/part_graph.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/migrate/partition.hpp"

namespace tessera::migrate {
namespace {

// Parts in a row, each beside the next.
PartGraph row_of(std::vector<GlobalIndex> sizes)
{
  PartGraph graph{.sizes = std::move(sizes)};
  const auto num_parts = static_cast<LocalIndex>(graph.sizes.size());
  for (LocalIndex p = 0; p < num_parts; ++p) {
    if (p > 0) graph.neighbours.values.push_back(p - 1);
    if (p + 1 < num_parts) graph.neighbours.values.push_back(p + 1);
    graph.neighbours.end_list();
  }
  return graph;
}

TEST(PlanTransfers, NothingIsMovedWhereAllIsWell)
{
  EXPECT_TRUE(plan_transfers(row_of({103, 97, 100}), 103, {}).empty());
}

TEST(PlanTransfers, ExcessGoesToANeighbourWithRoom)
{
  const std::vector<Transfer> expected{{0, 1, 7}};
  EXPECT_EQ(plan_transfers(row_of({110, 90, 100}), 103, {}), expected);
}

TEST(PlanTransfers, RoomComesNearerWhenItIsFarAway)
{
  const std::vector<Transfer> expected{{2, 3, 7}};
  EXPECT_EQ(plan_transfers(row_of({110, 100, 100, 90}), 103, {}), expected);
}

TEST(PlanTransfers, RoundsEndWithAllPartsSmallEnough)
{
  std::vector<GlobalIndex> sizes{180, 100, 101, 99, 100, 20};
  int rounds = 0;
  for (; rounds < 100; ++rounds) {
    const auto transfers = plan_transfers(row_of(sizes), 103, {});
    if (transfers.empty()) break;
    for (const Transfer& transfer : transfers) {
      sizes[at(transfer.from)] -= transfer.num_tets;
      sizes[at(transfer.to)] += transfer.num_tets;
    }
  }
  EXPECT_LT(rounds, 100);
  for (const GlobalIndex size : sizes) EXPECT_LE(size, 103);
}

TEST(PlanTransfers, NoPartTakesPartInTwo)
{
  const auto transfers = plan_transfers(row_of({120, 80, 120, 80}), 103, {});
  ASSERT_EQ(transfers.size(), 2U);
  EXPECT_EQ(transfers[0].from, 0);
  EXPECT_EQ(transfers[1].from, 2);
  EXPECT_EQ(transfers[1].to, 3);
}

TEST(PlanTransfers, BannedPairsAreLeftOut)
{
  EXPECT_TRUE(plan_transfers(row_of({110, 90}), 103, {{0, 1}}).empty());
}

TEST(RankOfPart, RanksHoldConsecutivePartsAsEvenlyAsPossible)
{
  for (const LocalIndex num_parts : {1, 2, 3, 7, 64}) {
    for (const int num_ranks : {1, 2, 3, 5, 8, 100}) {
      std::vector<int> held(static_cast<std::size_t>(num_ranks), 0);
      Rank last = 0;
      for (LocalIndex part = 0; part < num_parts; ++part) {
        const Rank rank = rank_of_part(part, num_parts, num_ranks);
        ASSERT_GE(rank, last);
        ASSERT_LT(rank, num_ranks);
        ++held[at(rank)];
        last = rank;
      }
      const auto [fewest, most] = std::minmax_element(held.begin(), held.end());
      EXPECT_LE(*most - *fewest, 1);
    }
  }
}

}  // namespace
}  // namespace tessera::migrate
