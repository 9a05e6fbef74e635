// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/comm/roll_call.hpp"

namespace tessera::comm {
namespace {

constexpr double kShort_s = 0.2;
constexpr double kForever_s = std::numeric_limits<double>::infinity();

class RollCallTest : public ::testing::Test {
 protected:
  // What a roll call says on this rank; empty if all have come.
  [[nodiscard]] static std::string said(const Communicator& ranks, double timeout_s)
  {
    try {
      roll_call(ranks.handle(), "call()", timeout_s);
    } catch (const UsageError& error) {
      EXPECT_EQ(dynamic_cast<const ThrownOnAllRanks*>(&error), nullptr);
      return error.what();
    }
    return "";
  }

  const Communicator comm_{MPI_COMM_WORLD};
};

TEST_F(RollCallTest, EndsWhenAllHaveCome)
{
  const Communicator ranks(comm_.handle());
  for (int i = 0; i < 20; ++i) EXPECT_EQ(said(ranks, i % 2 == 0 ? 60.0 : kForever_s), "");
  EXPECT_FALSE(failed_roll_call().has_value());
}

TEST_F(RollCallTest, WaitsForALateRank)
{
  if (comm_.size() == 1) GTEST_SKIP() << "nobody to wait for";
  const Communicator ranks(comm_.handle());
  // Rank 0 comes when it knows that another one is about to be in the call.
  if (comm_.rank() + 1 == comm_.size()) MPI_Send(nullptr, 0, MPI_BYTE, 0, 7, comm_.handle());
  if (comm_.rank() == 0) {
    MPI_Recv(nullptr, 0, MPI_BYTE, comm_.size() - 1, 7, comm_.handle(), MPI_STATUS_IGNORE);
  }
  EXPECT_EQ(said(ranks, 60.0), "");
}

TEST_F(RollCallTest, WhoDoesNotComeIsNamedOnAllThatDo)
{
  if (comm_.size() == 1) GTEST_SKIP() << "nobody to wait for";
  const std::string size = std::to_string(comm_.size());
  std::vector<std::pair<std::vector<Rank>, std::string>> absences{
      {{0}, "rank 0 of " + size + " has"},
      {{comm_.size() - 1}, "rank " + std::to_string(comm_.size() - 1) + " of " + size + " has"}};
  if (comm_.size() == 4) absences.push_back({{0, 2}, "ranks 0, 2 of 4 have"});
  for (const auto& [absent, named] : absences) {
    const Communicator ranks(comm_.handle());
    const bool is_absent = std::ranges::count(absent, comm_.rank()) != 0;
    // Only the lowest of the others is impatient: it speaks for all.
    const double timeout_s = comm_.rank() == (absent[0] == 0 ? 1 : 0) ? kShort_s : 60.0;
    const std::string heard = is_absent ? "" : said(ranks, timeout_s);
    comm_.quiet_barrier();
    if (is_absent) {
      EXPECT_NE(said(ranks, kForever_s).find("when others no longer waited"), std::string::npos);
      continue;
    }
    EXPECT_EQ(heard.find("call(): " + named + " not called it in "), 0U) << heard;
    EXPECT_EQ(said(ranks, kForever_s), heard);  // It does not wait once more.
    EXPECT_TRUE(failed_roll_call().has_value());
  }
}

TEST_F(RollCallTest, OtherCommunicatorsStillWork)
{
  const Communicator ranks(comm_.handle());
  EXPECT_EQ(said(ranks, 60.0), "");
  EXPECT_EQ(ranks.sum(1), comm_.size());
}

}  // namespace
}  // namespace tessera::comm
