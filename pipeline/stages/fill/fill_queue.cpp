// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/fill_queue.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pipeline/jobs/run_job.hpp"

namespace tessera::pipeline {
namespace {

// Most fills have ended by then.
constexpr double kHeadStart_s = 3.0;

}  // namespace

FillQueue::FillQueue(std::vector<LocalIndex> order,
                     std::vector<std::vector<fill::KernelKind>> kernels,
                     std::function<double()> seconds)
    : order_(std::move(order)), seconds_(std::move(seconds))
{
  for (std::vector<fill::KernelKind>& one : kernels) {
    most_tries_ = std::max(most_tries_, static_cast<LocalIndex>(one.size()));
    ranges_.push_back({.kernels = std::move(one)});
  }
  for (std::size_t place = 0; place < order_.size(); ++place) {
    ranges_[at(order_[place])].place = place;
  }
}

LocalIndex FillQueue::item_of(LocalIndex range, std::size_t number) const
{
  return range * most_tries_ + static_cast<LocalIndex>(number);
}

comm::Task FillQueue::start(LocalIndex number_of_range, std::size_t number, bool is_probe)
{
  Range& range = ranges_[at(number_of_range)];
  range.at_work[static_cast<LocalIndex>(number)] = is_probe;
  const FillOrder order{number_of_range, static_cast<LocalIndex>(number), is_probe, range.tries};
  return {item_of(number_of_range, number), to_bytes(order)};
}

std::optional<comm::Task> FillQueue::next()
{
  if (is_settled()) return std::nullopt;
  auto task = next_try();
  return task ? std::move(task) : next_probe();
}

std::optional<comm::Task> FillQueue::next_try()
{
  for (const std::size_t place : active_) {
    const LocalIndex r = order_[place];
    const Range& range = ranges_[at(r)];
    if (!range.at_work.contains(static_cast<LocalIndex>(range.current)))
      return start(r, range.current, false);
  }
  if (num_begun_ == order_.size()) return std::nullopt;
  const LocalIndex r = order_[num_begun_];
  active_.insert(num_begun_++);
  ranges_[at(r)].start_s = seconds_();
  return start(r, 0, false);
}

// Of several hard ranges the first one in order gets its probes first.
std::optional<comm::Task> FillQueue::next_probe()
{
  for (const std::size_t place : active_) {
    const LocalIndex r = order_[place];
    const Range& range = ranges_[at(r)];
    if (range.tries.is_made) continue;
    const bool is_hard = range.current > 0 || seconds_() - range.start_s >= kHeadStart_s;
    if (!is_hard) continue;
    if (const auto number = probe_of(range)) return start(r, *number, true);
  }
  return std::nullopt;
}

// The last try is the quick one that cannot fail.
std::optional<std::size_t> FillQueue::probe_of(const Range& range)
{
  for (std::size_t number = range.current + 1; number + 1 < range.kernels.size(); ++number) {
    const auto known = range.probed.find(static_cast<LocalIndex>(number));
    if (known != range.probed.end() && known->second.is_made()) return std::nullopt;
    if (known == range.probed.end() && !range.at_work.contains(static_cast<LocalIndex>(number)))
      return number;
  }
  return std::nullopt;
}

void FillQueue::ended(LocalIndex item, const Bytes& bytes, Rank rank)
{
  Range& range = ranges_[at(item / most_tries_)];
  const LocalIndex number = item % most_tries_;
  const auto at_work = range.at_work.extract(number);
  // A rank whose work threw says nothing; it stops the run.
  if (bytes.empty() || range.is_done) return;
  const auto verdict = from_bytes<FillVerdict>(bytes);
  if (at_work.mapped()) {
    range.probed[number] = verdict;
  } else {
    take(range, verdict, rank);
  }
  take_failed_probes(range);
  if (!range.is_done) return;
  ++num_done_;
  active_.erase(range.place);
  if (!range.tries.is_made) hopeless_ = item / most_tries_;
}

// A failure leads to the next try; a poor result of NETGEN, to one more try.
void FillQueue::take(Range& range, const FillVerdict& verdict, Rank rank)
{
  FillTries& tries = range.tries;
  const bool had_one = tries.is_made;
  const fill::KernelKind kernel = range.kernels[range.current];
  ++range.current;
  ++tries.count;
  tries.was_limited = tries.was_limited || depends_on_machine(verdict.end);
  if (verdict.is_made()) {
    tries.is_made = true;
    tries.holder = rank;
    tries.angle_to_beat_deg = verdict.angle_deg;
  } else {
    tries.failures.push_back(
        fmt::format("try {} ({}): {}", tries.count, word_of(kernel), verdict.end.message));
  }
  const bool is_last = range.current == range.kernels.size();
  const bool may_be_better = verdict.is_made() && verdict.is_poor && !had_one && !is_last
                             && range.kernels[range.current] == fill::KernelKind::netgen;
  range.is_done = is_last || (tries.is_made && !may_be_better);
}

void FillQueue::take_failed_probes(Range& range)
{
  while (!range.is_done) {
    const auto known = range.probed.find(static_cast<LocalIndex>(range.current));
    if (known == range.probed.end() || known->second.is_made()) return;
    take(range, known->second, 0);
  }
}

void FillQueue::dropped(LocalIndex item)
{
  ranges_[at(item / most_tries_)].at_work.erase(item % most_tries_);
}

bool FillQueue::is_needed(LocalIndex item) const
{
  const Range& range = ranges_[at(item / most_tries_)];
  if (range.is_done) return false;
  const auto number = static_cast<std::size_t>(item % most_tries_);
  // What a probe has made may fail when its turn comes, by a limit or on another machine.
  for (const auto& [known, verdict] : range.probed) {
    if (verdict.is_made() && range.current <= at(known) && at(known) < number) return false;
  }
  // With a result there is one more try at most, the current one.
  return number == range.current || (number > range.current && !range.tries.is_made);
}

bool FillQueue::is_settled() const { return hopeless_ || num_done_ == ranges_.size(); }

std::vector<FillTries> FillQueue::tries() const
{
  std::vector<FillTries> all;
  for (const Range& range : ranges_) all.push_back(range.tries);
  return all;
}

}  // namespace tessera::pipeline
