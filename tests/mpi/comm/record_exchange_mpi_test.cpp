// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/communicator.hpp"
#include "tessera/comm/record_exchange.hpp"

namespace tessera::comm {
namespace {

struct Record {
  GlobalIndex number = 0;
  Rank from = 0;
  std::string text{};  // Records may be of any length.

  static auto fields(auto& self) { return std::tie(self.number, self.from, self.text); }
};

std::string text_of(GlobalIndex number)
{
  return std::string(static_cast<std::size_t>(number % 5), 'x') + std::to_string(number);
}

class RecordExchangeTest : public ::testing::Test {
 protected:
  // Number n goes to rank n mod size.
  [[nodiscard]] RecordExchange<Record> exchange(const std::vector<Record>& sent) const
  {
    const auto hash = [](const Record& record) {
      return static_cast<std::uint64_t>(record.number);
    };
    return {std::span(sent), hash, comm_};
  }

  [[nodiscard]] std::vector<Record> numbers_below(GlobalIndex count) const
  {
    std::vector<Record> records;
    for (GlobalIndex n = 0; n < count; ++n) records.push_back({n, comm_.rank(), text_of(n)});
    return records;
  }

  const Communicator comm_{MPI_COMM_WORLD};
};

TEST_F(RecordExchangeTest, BringsRecordsToTheRankOfTheirKey)
{
  constexpr GlobalIndex kCount = 100;
  const RecordExchange<Record> records = exchange(numbers_below(kCount));
  std::size_t expected = 0;
  for (GlobalIndex n = comm_.rank(); n < kCount; n += comm_.size()) ++expected;
  EXPECT_EQ(records.received().size(), expected * static_cast<std::size_t>(comm_.size()));
  for (const Record& record : records.received()) {
    EXPECT_EQ(record.number % comm_.size(), comm_.rank());
    EXPECT_EQ(record.text, text_of(record.number));
  }
}

// Ranks send different numbers of records, and the last one none.
TEST_F(RecordExchangeTest, BringsAnswersBackInTheOrderOfTheQuestions)
{
  const bool is_last = comm_.rank() + 1 == comm_.size();
  const std::vector<Record> sent =
      numbers_below(is_last && comm_.size() > 1 ? 0 : 10 + 3 * comm_.rank());
  const RecordExchange<Record> records = exchange(sent);
  std::vector<std::string> answers;
  for (const Record& record : records.received()) {
    answers.push_back(record.text + " of " + std::to_string(record.from));
  }
  const auto own = records.answer(std::span<const std::string>(answers), comm_);
  EXPECT_EQ(own.size(), sent.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_EQ(own[i], sent[i].text + " of " + std::to_string(comm_.rank()));
  }
}

TEST_F(RecordExchangeTest, OfNothingIsNothing)
{
  const RecordExchange<Record> records = exchange({});
  EXPECT_TRUE(records.received().empty());
  EXPECT_TRUE(records.answer(std::span<const int>(), comm_).empty());
}

TEST_F(RecordExchangeTest, GivesAwayWhatItHasReceived)
{
  RecordExchange<Record> records = exchange(numbers_below(comm_.size()));
  const std::vector<Record> taken = std::move(records).take_received();
  EXPECT_EQ(taken.size(), static_cast<std::size_t>(comm_.size()));
}

}  // namespace
}  // namespace tessera::comm
