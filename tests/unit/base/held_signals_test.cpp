// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/held_signals.hpp"

#include <csignal>

#include <gtest/gtest.h>

namespace tessera {
namespace {

volatile std::sig_atomic_t num_caught = 0;

void count_signal(int /*signal*/) { num_caught = num_caught + 1; }

class HeldSignalsTest : public ::testing::Test {
 protected:
  HeldSignalsTest()
  {
    num_caught = 0;
    before_ = std::signal(SIGUSR1, count_signal);
  }
  ~HeldSignalsTest() override { std::signal(SIGUSR1, before_); }

 private:
  void (*before_)(int) = nullptr;
};

TEST_F(HeldSignalsTest, ComeAtTheEnd)
{
  {
    const HeldSignals held{SIGUSR1};
    std::raise(SIGUSR1);
    EXPECT_EQ(num_caught, 0);
  }
  EXPECT_EQ(num_caught, 1);
}

TEST_F(HeldSignalsTest, GoToTheHandlerOfBefore)
{
  {
    const HeldSignals held{SIGUSR1, SIGUSR2};
    std::signal(SIGUSR1, SIG_IGN);
    std::signal(SIGUSR1, SIG_DFL);  // Would end this process.
    std::raise(SIGUSR1);
  }
  EXPECT_EQ(num_caught, 1);
}

TEST_F(HeldSignalsTest, StayHeldIfTheyWereBefore)
{
  const HeldSignals outer{SIGUSR1};
  {
    const HeldSignals inner{SIGUSR1};
    std::raise(SIGUSR1);
  }
  EXPECT_EQ(num_caught, 0);
}

TEST_F(HeldSignalsTest, AreThoseThatAreNamed)
{
  const HeldSignals held{SIGUSR2};
  std::raise(SIGUSR1);
  EXPECT_EQ(num_caught, 1);
}

}  // namespace
}  // namespace tessera
