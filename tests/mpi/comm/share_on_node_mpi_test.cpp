// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/share_on_node.hpp"

namespace tessera::comm {
namespace {

using Numbers = FlatArray<LocalIndex>;

Numbers first_numbers(std::size_t count)
{
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// The inode of what this process has mapped at that place, as the kernel tells it; 0: none.
std::uint64_t inode_mapped_at(const void* place)
{
  std::ifstream maps("/proc/self/maps");
  const auto wanted = reinterpret_cast<std::uintptr_t>(place);
  for (std::string line; std::getline(maps, line);) {
    const std::uintptr_t begin = std::stoull(line, nullptr, 16);
    const std::uintptr_t end = std::stoull(line.substr(line.find('-') + 1), nullptr, 16);
    if (wanted < begin || wanted >= end) continue;
    std::istringstream words(line);
    std::string word;
    for (int i = 0; i < 5; ++i) words >> word;
    return std::stoull(word);
  }
  return 0;
}

struct ShareOnNode : ::testing::Test {
  const Communicator comm{MPI_COMM_WORLD};

  // All ranks of a test are on one node. `refuses`: a rank that cannot share; -1: none.
  [[nodiscard]] NodeShare share(Rank refuses = -1) const
  {
    return share_on_node(
        comm, [] { return first_numbers(100000); },
        [&] {
          if (comm.rank() == refuses) throw Error("no memory today");
        });
  }
};

TEST_F(ShareOnNode, AllRanksOfANodeReadOneMapping)
{
  const NodeShare made = share();
  EXPECT_EQ(made.obstacle, "");
  const auto numbers = from_shared_bytes<Numbers>(made.bytes);
  EXPECT_EQ(numbers, first_numbers(100000));
  const std::uint64_t mine = inode_mapped_at(&numbers.back());
  EXPECT_NE(mine, 0U);
  for (const std::uint64_t inode : comm.all_gather_values(mine)) EXPECT_EQ(inode, mine);
}

TEST_F(ShareOnNode, OnlyTheFirstRankRunsTheWork)
{
  int num_runs = 0;
  const NodeShare made = share_on_node(
      comm,
      [&] {
        ++num_runs;
        return first_numbers(3);
      },
      [] {});
  EXPECT_EQ(num_runs, comm.rank() == 0 ? 1 : 0);
  EXPECT_EQ(from_shared_bytes<Numbers>(made.bytes), first_numbers(3));
}

TEST_F(ShareOnNode, EachRankHasACopyIfOneCannotShare)
{
  for (Rank refuses = 0; refuses < comm.size(); ++refuses) {
    const NodeShare made = share(refuses);
    EXPECT_EQ(made.obstacle, "no memory today");
    EXPECT_FALSE(made.bytes.segment());
    const auto numbers = from_shared_bytes<Numbers>(made.bytes);
    EXPECT_EQ(numbers, first_numbers(100000));
    EXPECT_EQ(inode_mapped_at(&numbers.back()), 0U);
  }
}

TEST_F(ShareOnNode, WhatRankZeroKnowsIsReadFromOneMapping)
{
  const auto numbers =
      on_root_of_nodes(comm, [&] { return comm.rank() == 0 ? first_numbers(100000) : Numbers{}; });
  EXPECT_EQ(numbers, first_numbers(100000));
  const std::uint64_t mine = inode_mapped_at(&numbers.back());
  EXPECT_NE(mine, 0U);
  for (const std::uint64_t inode : comm.all_gather_values(mine)) EXPECT_EQ(inode, mine);
}

TEST_F(ShareOnNode, AnErrorOfRankZeroIsOneOfAllRanks)
{
  const auto failing = [&] {
    return on_root_of_nodes(comm, []() -> Numbers { throw MeshError("no mesh"); });
  };
  EXPECT_THROW(static_cast<void>(failing()), Collective<MeshError>);
}

TEST_F(ShareOnNode, AnErrorOfTheWorkIsOneOfAllRanks)
{
  const auto failing = [&] {
    return share_on_node(
        comm, []() -> Numbers { throw MeshError("no mesh"); }, [] {});
  };
  EXPECT_THROW(static_cast<void>(failing()), Collective<MeshError>);
}

TEST_F(ShareOnNode, RanksOfTheNodeAreAllOfThisMachine)
{
  const Communicator node = comm.ranks_of_node();
  EXPECT_EQ(node.size(), comm.size());
  EXPECT_EQ(node.rank(), comm.rank());
}

}  // namespace
}  // namespace tessera::comm
