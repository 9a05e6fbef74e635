// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_ladder.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tessera::pipeline {
namespace {

// Most rungs that work have ended by then, and nobody has worked in vain.
constexpr double kHeadStart_s = 3.0;

}  // namespace

CoarseLadder::CoarseLadder(const std::vector<RungKind>& kinds, std::function<double()> seconds)
    : seconds_(std::move(seconds))
{
  for (const RungKind& kind : kinds) rungs_.push_back({.kind = kind});
}

std::size_t CoarseLadder::front_of(const std::vector<Rung>& rungs, std::vector<LocalIndex>* passed)
{
  bool was_endless = false;
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    const Rung& rung = rungs[i];
    if (i > 0 && rung.kind.is_cut != rungs[i - 1].kind.is_cut) was_endless = false;
    if (was_endless && rung.kind.is_netgen) continue;
    if (rung.state != State::failed && rung.state != State::endless) return i;
    was_endless = was_endless || (rung.kind.is_netgen && rung.state == State::endless);
    if (passed != nullptr) passed->push_back(static_cast<LocalIndex>(i));
  }
  return rungs.size();
}

// What would be tried one after the other if all that is not decided ended like this.
std::vector<LocalIndex> CoarseLadder::followers_if(State state) const
{
  std::vector<LocalIndex> followers;
  std::vector<Rung> rungs = rungs_;
  for (std::size_t i = front_of(rungs, nullptr); i < rungs.size(); i = front_of(rungs, nullptr)) {
    if (rungs[i].state == State::surface || rungs[i].state == State::final) break;
    followers.push_back(static_cast<LocalIndex>(i));
    rungs[i].state = state;
  }
  return followers;
}

comm::Task CoarseLadder::start(std::size_t rung)
{
  rungs_[rung].state = State::running;
  rungs_[rung].start_s = seconds_();
  return {.item = static_cast<LocalIndex>(rung)};
}

std::optional<comm::Task> CoarseLadder::next()
{
  const std::size_t front = front_of(rungs_, nullptr);
  if (is_settled()) return std::nullopt;
  if (rungs_[front].state == State::waiting) return start(front);
  const bool has_failed = !failed().empty();
  if (!has_failed && seconds_() - rungs_[front].start_s < kHeadStart_s) return std::nullopt;
  for (const State state :
       {has_failed ? State::failed : State::endless, has_failed ? State::endless : State::failed}) {
    for (const LocalIndex rung : followers_if(state)) {
      if (rungs_[at(rung)].state == State::waiting) return start(at(rung));
    }
  }
  return std::nullopt;
}

void CoarseLadder::ended(LocalIndex rung, const Bytes& verdict, Rank rank)
{
  // A rank whose work threw says nothing; it stops the run.
  const RungEnd end = verdict.empty() ? RungEnd::failed : from_bytes<RungEnd>(verdict);
  constexpr std::array kStates{State::failed, State::endless, State::final, State::surface};
  rungs_[at(rung)].state = kStates.at(static_cast<std::size_t>(end));
  rungs_[at(rung)].holder = rank;
}

void CoarseLadder::dropped(LocalIndex rung) { rungs_[at(rung)].state = State::waiting; }

bool CoarseLadder::is_needed(LocalIndex rung) const
{
  if (is_settled()) return false;
  return std::ranges::count(followers_if(State::failed), rung) > 0
         || std::ranges::count(followers_if(State::endless), rung) > 0;
}

bool CoarseLadder::is_settled() const
{
  const std::size_t front = front_of(rungs_, nullptr);
  return front == rungs_.size() || rungs_[front].state == State::surface
         || rungs_[front].state == State::final;
}

void CoarseLadder::fill_has_failed(LocalIndex rung, RungEnd end)
{
  rungs_[at(rung)].state = end == RungEnd::endless ? State::endless : State::failed;
}

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
  const std::size_t front = front_of(rungs_, nullptr);
  if (front == rungs_.size()) return std::nullopt;
  return static_cast<LocalIndex>(front);
}

std::vector<LocalIndex> CoarseLadder::failed() const
{
  std::vector<LocalIndex> passed;
  front_of(rungs_, &passed);
  return passed;
}

}  // namespace tessera::pipeline
