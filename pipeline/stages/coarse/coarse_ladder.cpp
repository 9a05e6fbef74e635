// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_ladder.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace tessera::pipeline {

CoarseLadder::CoarseLadder(std::size_t num_rungs, std::function<double()> seconds,
                           double head_start_s)
    : rungs_(num_rungs), seconds_(std::move(seconds)), head_start_s_(head_start_s)
{
}

std::size_t CoarseLadder::first_not_failed() const
{
  const auto found =
      std::ranges::find_if(rungs_, [](const Rung& rung) { return rung.state != State::failed; });
  return static_cast<std::size_t>(found - rungs_.begin());
}

// What is behind it is tried in vain.
std::size_t CoarseLadder::first_decided() const
{
  return static_cast<std::size_t>(std::ranges::find_if(rungs_, is_decided) - rungs_.begin());
}

std::optional<comm::Task> CoarseLadder::next()
{
  if (is_settled()) return std::nullopt;
  const std::size_t front = first_not_failed();
  const bool may_go_on = front > 0 || rungs_[0].state == State::waiting
                         || seconds_() - first_start_s_ >= head_start_s_;
  for (std::size_t i = front; may_go_on && i < first_decided(); ++i) {
    if (rungs_[i].state != State::waiting) continue;
    rungs_[i].state = State::running;
    if (i == 0) first_start_s_ = seconds_();
    return comm::Task{.item = static_cast<LocalIndex>(i)};
  }
  return std::nullopt;
}

void CoarseLadder::ended(LocalIndex rung, const Bytes& verdict, Rank rank)
{
  // A rank whose work threw says nothing; it stops the run.
  const RungEnd end = verdict.empty() ? RungEnd::failed : from_bytes<RungEnd>(verdict);
  constexpr std::array kStates{State::failed, State::final, State::surface};
  rungs_[at(rung)].state = kStates.at(static_cast<std::size_t>(end));
  rungs_[at(rung)].holder = rank;
}

void CoarseLadder::dropped(LocalIndex rung) { rungs_[at(rung)].state = State::waiting; }

bool CoarseLadder::is_needed(LocalIndex rung) const
{
  return !is_settled() && at(rung) >= first_not_failed() && at(rung) < first_decided();
}

bool CoarseLadder::is_settled() const
{
  const std::size_t front = first_not_failed();
  return front == rungs_.size() || is_decided(rungs_[front]);
}

void CoarseLadder::fill_has_failed(LocalIndex rung) { rungs_[at(rung)].state = State::failed; }

std::vector<LocalIndex> CoarseLadder::snapshot() const
{
  std::vector<LocalIndex> numbers;
  for (const Rung& rung : rungs_) {
    numbers.insert(numbers.end(), {static_cast<LocalIndex>(rung.state), rung.holder});
  }
  return numbers;
}

void CoarseLadder::restore(const std::vector<LocalIndex>& snapshot)
{
  for (std::size_t i = 0; i < rungs_.size(); ++i) {
    rungs_[i].state = static_cast<State>(snapshot.at(2 * i));
    rungs_[i].holder = snapshot.at(2 * i + 1);
  }
}

std::optional<LocalIndex> CoarseLadder::front() const
{
  const std::size_t front = first_not_failed();
  if (front == rungs_.size()) return std::nullopt;
  return static_cast<LocalIndex>(front);
}

std::vector<LocalIndex> CoarseLadder::failed() const
{
  std::vector<LocalIndex> failed(first_not_failed());
  std::iota(failed.begin(), failed.end(), 0);
  return failed;
}

}  // namespace tessera::pipeline
