// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/fill_queue.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

const std::vector<KernelKind> kTries{KernelKind::netgen, KernelKind::netgen, KernelKind::netgen,
                                     KernelKind::subdivide};

class FillQueueTest : public ::testing::Test {
 protected:
  // Ranges 1, 0.
  FillQueue queue_{{1, 0}, {kTries, kTries}, [this] { return now_s_; }};
  double now_s_ = 0.0;

  FillOrder next()
  {
    const auto task = queue_.next();
    EXPECT_TRUE(task);
    last_ = task->item;
    return from_bytes<FillOrder>(task->more);
  }
  void end(LocalIndex item, const FillVerdict& verdict, Rank rank = 0)
  {
    queue_.ended(item, to_bytes(verdict), rank);
  }
  static FillVerdict failed(const std::string& why)
  {
    return {.end = {.status = jobs::JobStatus::failed, .message = why}};
  }
  static FillVerdict made(bool is_poor = false, double angle = 12.0)
  {
    return {.is_poor = is_poor, .angle_deg = angle};
  }

  // Range 1 is at its first try for long, range 0 is done.
  LocalIndex begin_hard_range()
  {
    next();
    const LocalIndex hard = last_;
    next();
    end(last_, made());
    now_s_ = 100.0;
    return hard;
  }

  LocalIndex last_ = 0;
};

TEST_F(FillQueueTest, BeginsInOrderAndHasNothingElseForTheStart)
{
  EXPECT_EQ(next().range, 1);
  EXPECT_EQ(next().range, 0);
  EXPECT_FALSE(queue_.next());
  EXPECT_EQ(queue_.num_begun(), 2);
}

TEST_F(FillQueueTest, AFailureLeadsToTheNextTryBeforeANewRange)
{
  next();
  end(last_, failed("no"));
  const FillOrder order = next();
  EXPECT_EQ(std::pair(order.range, order.number), std::pair(1, 1));
  EXPECT_FALSE(order.is_probe);
  EXPECT_EQ(order.before.failures, std::vector<std::string>{"try 1 (netgen): no"});
}

TEST_F(FillQueueTest, IdleRanksProbeTheLaterTriesOfAHardRange)
{
  const LocalIndex hard = begin_hard_range();
  for (const LocalIndex number : {1, 2}) {
    const FillOrder order = next();
    EXPECT_EQ(std::pair(order.range, order.number), std::pair(1, number));
    EXPECT_TRUE(order.is_probe);
    EXPECT_TRUE(queue_.is_needed(last_));
    end(last_, failed("nor so"));
  }
  EXPECT_FALSE(queue_.next());  // Subdivision is no probe.
  end(hard, failed("no"));
  const FillOrder order = next();
  EXPECT_EQ(order.number, 3);
  EXPECT_FALSE(order.is_probe);
  EXPECT_EQ(order.before.count, 3);
  EXPECT_EQ(order.before.failures.size(), 3U);
  EXPECT_EQ(order.before.failures[2], "try 3 (netgen): nor so");
  end(last_, made(), 4);
  EXPECT_TRUE(queue_.is_settled());
  EXPECT_EQ(queue_.tries()[1].count, 4);
  EXPECT_EQ(queue_.tries()[1].holder, 4);
}

TEST_F(FillQueueTest, AProbeThatDoesNotFailIsMadeOnceMoreToBeKept)
{
  const LocalIndex hard = begin_hard_range();
  EXPECT_TRUE(next().is_probe);
  end(last_, made());
  EXPECT_FALSE(queue_.next());  // Nothing behind it is needed.
  end(hard, failed("no"));
  const FillOrder order = next();
  EXPECT_EQ(order.number, 1);
  EXPECT_FALSE(order.is_probe);
}

// As a limit may end it on a slower machine.
TEST_F(FillQueueTest, AProbeThatWorkedMayFailWhenItsTurnHasCome)
{
  const LocalIndex hard = begin_hard_range();
  EXPECT_TRUE(next().is_probe);
  end(last_, made());
  end(hard, failed("no"));
  EXPECT_EQ(next().number, 1);
  end(last_, failed("out of time"));
  EXPECT_EQ(next().number, 2);
  EXPECT_TRUE(queue_.is_needed(last_));
}

TEST_F(FillQueueTest, ProbesOfAnEasyRangeAreNoLongerNeeded)
{
  next();
  const LocalIndex hard = last_;
  next();
  now_s_ = 100.0;
  next();
  const LocalIndex probe = last_;
  end(hard, made());
  EXPECT_FALSE(queue_.is_needed(probe));
  queue_.dropped(probe);
  EXPECT_FALSE(queue_.is_settled());
}

TEST_F(FillQueueTest, APoorResultHasOneMoreTryAndTheBetterOneStays)
{
  next();
  end(last_, made(true, 3.0), 1);
  const FillOrder order = next();
  EXPECT_EQ(order.number, 1);
  EXPECT_EQ(order.before.angle_to_beat_deg, 3.0);
  end(last_, failed("not better"), 2);
  EXPECT_EQ(queue_.tries()[1].holder, 1);
  EXPECT_EQ(queue_.tries()[1].count, 2);
  EXPECT_EQ(next().range, 0);
}

TEST_F(FillQueueTest, ARangeWithoutAnyTryThatWorksIsTheEnd)
{
  for (std::size_t i = 0; i < kTries.size(); ++i) {
    EXPECT_EQ(next().range, 1);
    end(last_, failed("no"));
  }
  EXPECT_TRUE(queue_.is_settled());
  EXPECT_EQ(queue_.hopeless(), 1);
}

}  // namespace
}  // namespace tessera::pipeline
