// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/threads.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

class Threads : public ::testing::Test {
 protected:
  void TearDown() override { set_num_threads(1); }
};

TEST_F(Threads, AProcessHasOneUnlessItWasToldOtherwise)
{
  EXPECT_EQ(num_threads(), 1);
  set_num_threads(3);
  EXPECT_EQ(num_threads(), 3);
  set_num_threads(0);
  EXPECT_EQ(num_threads(), 1);
}

TEST_F(Threads, EveryItemIsDoneOnce)
{
  for (const int threads : {1, 3, 200}) {
    set_num_threads(threads);
    std::vector<int> done(100, 0);
    for_each_in_threads(done.size(), [&](std::size_t item) { ++done[item]; });
    EXPECT_EQ(done, std::vector<int>(100, 1)) << threads << " threads";
  }
  for_each_in_threads(0, [](std::size_t /*item*/) { FAIL() << "there is no item"; });
}

TEST_F(Threads, ChunksCoverAllItemsOnce)
{
  set_num_threads(2);
  for (const std::size_t count : {0U, 1U, 10'000U}) {
    std::vector<int> done(count, 0);
    for_each_chunk_in_threads(count, [&](std::size_t first, std::size_t last) {
      for (std::size_t item = first; item < last; ++item) ++done[item];
    });
    EXPECT_EQ(done, std::vector<int>(count, 1));
  }
}

// Each of two items waits for the other one.
TEST_F(Threads, ItemsAreDoneSideBySide)
{
  set_num_threads(2);
  std::atomic<int> begun{0};
  for_each_in_threads(2, [&](std::size_t /*item*/) {
    ++begun;
    while (begun < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  EXPECT_EQ(begun, 2);
}

TEST_F(Threads, OfSeveralErrorsThatOfTheFirstItemIsThrown)
{
  for (const int threads : {1, 4}) {
    set_num_threads(threads);
    std::atomic<int> done{0};
    try {
      for_each_in_threads(20, [&](std::size_t item) {
        if (item % 7 == 5) throw std::runtime_error(std::to_string(item));
        ++done;
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "5") << threads << " threads";
    }
    EXPECT_EQ(done, 17) << "the others are ended";
  }
}

}  // namespace
}  // namespace tessera
