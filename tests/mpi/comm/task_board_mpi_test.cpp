// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <map>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/task_board.hpp"

namespace tessera::comm {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// Items in order; the lowest one with verdict 1 wins, and higher ones are no longer needed.
class FirstGood final : public TaskSource {
 public:
  explicit FirstGood(LocalIndex count) : state_(static_cast<std::size_t>(count)) {}

  [[nodiscard]] std::optional<Task> next() override
  {
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_[i] == State::good) return std::nullopt;
      if (state_[i] != State::waiting) continue;
      state_[i] = State::running;
      return Task{static_cast<LocalIndex>(i), to_bytes(10 * static_cast<LocalIndex>(i))};
    }
    return std::nullopt;
  }
  void ended(LocalIndex item, const Bytes& verdict, Rank rank) override
  {
    state_[static_cast<std::size_t>(item)] =
        from_bytes<int>(verdict) == 1 ? State::good : State::bad;
    by_[item] = rank;
  }
  void dropped(LocalIndex item) override
  {
    state_[static_cast<std::size_t>(item)] = State::waiting;
    ++num_dropped_;
  }
  [[nodiscard]] bool is_needed(LocalIndex item) const override
  {
    for (LocalIndex i = 0; i < item; ++i) {
      if (state_[static_cast<std::size_t>(i)] == State::good) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_settled() const override
  {
    for (const State state : state_) {
      if (state == State::good) return true;
      if (state != State::bad) return false;
    }
    return true;
  }

  [[nodiscard]] LocalIndex winner() const
  {
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_[i] == State::good) return static_cast<LocalIndex>(i);
    }
    return kNoIndex;
  }
  [[nodiscard]] const std::map<LocalIndex, Rank>& by() const { return by_; }
  [[nodiscard]] int num_dropped() const { return num_dropped_; }

 private:
  enum class State { waiting, running, good, bad };
  std::vector<State> state_;
  std::map<LocalIndex, Rank> by_{};
  int num_dropped_ = 0;
};

bool never() { return false; }

// Returns after the time, or when the item is no longer needed.
void work_for(milliseconds duration, const std::function<bool()>& on_wait)
{
  const auto end = Clock::now() + duration;
  while (Clock::now() < end && on_wait()) std::this_thread::sleep_for(milliseconds(1));
}

TEST(TaskBoard, TheFirstGoodItemWinsWhoeverIsFaster)
{
  const Communicator comm(MPI_COMM_WORLD);
  FirstGood source(5);
  const std::vector<int> duration_ms{30, 60, 5, 5, 5};
  const std::vector<int> verdict{0, 1, 1, 0, 1};
  TaskBoard(comm, source)
      .run(
          [&](const Task& task, const auto& on_wait) {
            const auto item = static_cast<std::size_t>(task.item);
            EXPECT_EQ(from_bytes<LocalIndex>(task.more), 10 * task.item);
            work_for(milliseconds(duration_ms[item]), on_wait);
            return to_bytes(verdict[item]);
          },
          never);
  if (comm.rank() != 0) return;
  EXPECT_EQ(source.winner(), 1);
  EXPECT_EQ(source.by().count(0), 1U);
}

TEST(TaskBoard, AllBadIsAnEnd)
{
  const Communicator comm(MPI_COMM_WORLD);
  FirstGood source(7);
  TaskBoard(comm, source).run([](const Task&, const auto&) { return to_bytes(0); }, never);
  if (comm.rank() != 0) return;
  EXPECT_EQ(source.by().size(), 7U);
  EXPECT_EQ(source.winner(), kNoIndex);
}

TEST(TaskBoard, WhatIsNoLongerNeededIsCancelled)
{
  const Communicator comm(MPI_COMM_WORLD);
  FirstGood source(comm.size());
  const auto start = Clock::now();
  TaskBoard(comm, source)
      .run(
          [&](const Task& task, const auto& on_wait) {
            work_for(task.item == 0 ? milliseconds(200) : milliseconds(60'000), on_wait);
            return to_bytes(task.item == 0 ? 1 : 0);
          },
          never);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(30));
  if (comm.rank() != 0) return;
  EXPECT_EQ(source.num_dropped(), comm.size() - 1);
}

TEST(TaskBoard, AStopOnAnyRankEndsItForAll)
{
  const Communicator comm(MPI_COMM_WORLD);
  const auto start = Clock::now();
  const auto is_stopped = [&] {
    return comm.rank() == comm.size() - 1 && Clock::now() - start > milliseconds(50);
  };
  FirstGood source(3);
  TaskBoard(comm, source)
      .run(
          [&](const Task&, const auto& on_wait) {
            work_for(milliseconds(60'000), on_wait);
            return to_bytes(1);
          },
          is_stopped);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(30));
}

TEST(TaskBoard, NothingToDo)
{
  const Communicator comm(MPI_COMM_WORLD);
  FirstGood source(0);
  TaskBoard(comm, source).run([](const Task&, const auto&) { return to_bytes(1); }, never);
  EXPECT_TRUE(source.by().empty());
}

}  // namespace
}  // namespace tessera::comm
