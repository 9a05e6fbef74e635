// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {
namespace {

// Seven does not divide the sizes below, so last pieces are shorter.
constexpr std::size_t kTinyPieces = 7;

// Bytes that tell who made them and where they belong in the message.
Bytes pattern(std::size_t size, int seed)
{
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>((i * 31 + static_cast<std::size_t>(seed) * 101) & 0xFFU);
  return bytes;
}

class CommunicatorPieces : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Communicator comm_{MPI_COMM_WORLD, GetParam()};
};

TEST_P(CommunicatorPieces, BroadcastGivesAllRanksTheBytesOfTheRoot)
{
  for (Rank root = 0; root < comm_.size(); ++root) {
    for (const std::size_t size : {0UL, 1UL, 7UL, 8UL, 100UL}) {
      const Bytes mine = comm_.rank() == root ? pattern(size, root) : pattern(3, 77);
      EXPECT_EQ(comm_.broadcast(mine, root), pattern(size, root));
    }
  }
}

TEST_P(CommunicatorPieces, GatherKeepsRankOrderAndDifferentSizes)
{
  const auto size_of = [](Rank rank) { return static_cast<std::size_t>(13 * rank); };
  const Bytes mine = pattern(size_of(comm_.rank()), comm_.rank());
  const std::vector<Bytes> at_root = comm_.gather_to_root(mine);
  const std::vector<Bytes> everywhere = comm_.all_gather(mine);

  ASSERT_EQ(everywhere.size(), static_cast<std::size_t>(comm_.size()));
  for (Rank rank = 0; rank < comm_.size(); ++rank)
    EXPECT_EQ(everywhere[static_cast<std::size_t>(rank)], pattern(size_of(rank), rank));
  if (comm_.rank() == 0)
    EXPECT_EQ(at_root, everywhere);
  else
    EXPECT_TRUE(at_root.empty());
}

TEST_P(CommunicatorPieces, SumsOfUnsignedWrapAround)
{
  std::vector<std::uint64_t> values(20, std::numeric_limits<std::uint64_t>::max());
  values.back() = 5;
  comm_.sum_in_place(values);
  const auto ranks = static_cast<std::uint64_t>(comm_.size());
  EXPECT_EQ(values.front(), std::uint64_t{0} - ranks);
  EXPECT_EQ(values.back(), 5 * ranks);
}

TEST_P(CommunicatorPieces, MaximumIsThatOfAllRanksEntryByEntry)
{
  // Each entry is largest on another rank.
  std::vector<std::uint64_t> values(20);
  const auto ranks = static_cast<std::uint64_t>(comm_.size());
  const auto rank = static_cast<std::uint64_t>(comm_.rank());
  for (std::uint64_t i = 0; i < 20; ++i) {
    const std::uint64_t rest = (i + rank) % ranks;
    values[i] = std::numeric_limits<std::uint64_t>::max() - rest;
  }
  comm_.max_in_place(values);
  EXPECT_EQ(values, std::vector<std::uint64_t>(20, std::numeric_limits<std::uint64_t>::max()));
}

TEST_P(CommunicatorPieces, ExchangeDeliversEveryMessageOnceInOrderOfSenders)
{
  // Rank r writes r + 1 messages to every rank, itself included, one of them empty.
  const auto size_of = [](Rank from, int i) { return static_cast<std::size_t>(i * (5 + from)); };
  std::vector<Message> messages;
  for (int i = 0; i <= comm_.rank(); ++i)
    for (Rank to = 0; to < comm_.size(); ++to)
      messages.push_back({to, pattern(size_of(comm_.rank(), i), comm_.rank() + 10 * i + 100 * to)});

  const std::vector<Message> received = comm_.exchange(std::move(messages));
  std::size_t at = 0;
  for (Rank from = 0; from < comm_.size(); ++from) {
    for (int i = 0; i <= from; ++i, ++at) {
      ASSERT_LT(at, received.size());
      EXPECT_EQ(received[at].rank, from);
      EXPECT_EQ(received[at].bytes, pattern(size_of(from, i), from + 10 * i + 100 * comm_.rank()));
    }
  }
  EXPECT_EQ(at, received.size());
}

TEST_P(CommunicatorPieces, ExchangesBehindEachOtherDoNotMix)
{
  // Only one rank writes, another one each time, so that most ranks are ahead of it.
  for (int round = 0; round < 40; ++round) {
    std::vector<Message> messages;
    const Rank writer = round % comm_.size();
    const Rank reader = (round * 7 + 1) % comm_.size();
    if (comm_.rank() == writer) messages.push_back({reader, pattern(10, round)});
    const std::vector<Message> received = comm_.exchange(std::move(messages));
    EXPECT_EQ(received.size(), comm_.rank() == reader ? 1U : 0U) << "round " << round;
    for (const Message& message : received) EXPECT_EQ(message.bytes, pattern(10, round));
  }
}

INSTANTIATE_TEST_SUITE_P(WholeAndInPieces, CommunicatorPieces,
                         ::testing::Values(kMaxMpiCount, kTinyPieces));

TEST(Communicator, ExchangePassesLargeMessagesBothWaysAtOnce)
{
  const Communicator comm(MPI_COMM_WORLD);
  constexpr std::size_t kSize = std::size_t{8} << 20;
  const Rank next = (comm.rank() + 1) % comm.size();
  const Rank previous = (comm.rank() + comm.size() - 1) % comm.size();
  const auto received =
      comm.exchange({{next, pattern(kSize, comm.rank())}, {previous, pattern(kSize, comm.rank())}});
  ASSERT_EQ(received.size(), 2U);
  for (const Message& message : received) EXPECT_EQ(message.bytes, pattern(kSize, message.rank));
}

TEST(Communicator, MaxAndMinAreThoseOfAllRanks)
{
  const Communicator comm(MPI_COMM_WORLD);
  EXPECT_EQ(comm.max(1.5 * comm.rank()), 1.5 * (comm.size() - 1));
  EXPECT_EQ(comm.min(1.5 * comm.rank()), 0.0);
}

TEST(Communicator, SumOfLowerRanksLeavesOutTheOwnValue)
{
  const Communicator comm(MPI_COMM_WORLD);
  GlobalIndex expected = 0;
  for (Rank rank = 0; rank < comm.rank(); ++rank) expected += 10 + rank;
  EXPECT_EQ(comm.sum_of_lower_ranks(10 + comm.rank()), expected);
}

TEST(Communicator, DefectOfOneRankIsThrownOnAll)
{
  const Communicator comm(MPI_COMM_WORLD);
  const bool is_last = comm.rank() == comm.size() - 1;
  EXPECT_THROW(
      comm.throw_if_any<MeshError>(is_last ? std::optional<std::string>("bad") : std::nullopt),
      Collective<MeshError>);
  EXPECT_NO_THROW(comm.throw_if_any<MeshError>(std::nullopt));
}

}  // namespace
}  // namespace tessera::comm
