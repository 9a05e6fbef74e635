// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/work_queue.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace tessera::comm {
namespace {

constexpr int kTag = 1;

// What other ranks say to rank 0.
constexpr std::int64_t kWantItem = -1;
constexpr std::int64_t kWantStop = -2;
constexpr std::int64_t kAmFinished = -3;
// What rank 0 answers, besides the number of an item.
constexpr std::int64_t kNothingLeft = -4;
constexpr std::int64_t kStop = -5;
constexpr std::int64_t kAllFinished = -6;

// Short against a job, long against a look at the messages, so waiting ranks leave the cores alone.
void rest() { std::this_thread::sleep_for(std::chrono::microseconds(300)); }

}  // namespace

WorkQueue::WorkQueue(const Communicator& communicator, std::vector<LocalIndex> order)
    : communicator_(communicator.handle()), order_(std::move(order))
{
}

WorkQueue::~WorkQueue() { finish(); }

std::optional<LocalIndex> WorkQueue::next()
{
  if (!progress()) return std::nullopt;
  if (communicator_.rank() == 0) return take_item();

  answer_.reset();
  send(0, kWantItem);
  for (progress(); !answer_; progress()) rest();
  if (*answer_ == kNothingLeft) return std::nullopt;
  return static_cast<LocalIndex>(*answer_);
}

bool WorkQueue::progress()
{
  sends_.remove_if([](PendingSend& pending) {
    int done = 0;
    MPI_Test(&pending.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  const Rank source = communicator_.rank() == 0 ? MPI_ANY_SOURCE : 0;
  while (true) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(source, kTag, communicator_.handle(), &there, &status);
    if (there == 0) return !stop_requested_;
    std::int64_t value = 0;
    MPI_Recv(&value, 1, MPI_INT64_T, status.MPI_SOURCE, kTag, communicator_.handle(),
             MPI_STATUS_IGNORE);
    if (communicator_.rank() == 0)
      serve(status.MPI_SOURCE, value);
    else
      accept(value);
  }
}

void WorkQueue::request_stop()
{
  if (stop_requested_) return;
  if (communicator_.rank() == 0) {
    stop_all();
  } else {
    stop_requested_ = true;
    send(0, kWantStop);
  }
}

bool WorkQueue::finish()
{
  if (finished_) return stop_requested_;
  if (communicator_.rank() == 0) {
    for (progress(); num_finished_ < communicator_.size() - 1; progress()) rest();
    for (Rank to = 1; to < communicator_.size(); ++to) send(to, kAllFinished);
    finished_ = true;
  } else {
    send(0, kAmFinished);
  }
  for (progress(); !finished_ || !sends_.empty(); progress()) rest();
  return stop_requested_;
}

void WorkQueue::send(Rank to, std::int64_t value)
{
  PendingSend& pending = sends_.emplace_back(PendingSend{.value = value});
  MPI_Isend(&pending.value, 1, MPI_INT64_T, to, kTag, communicator_.handle(), &pending.request);
}

void WorkQueue::serve(Rank from, std::int64_t request)
{
  if (request == kWantItem) {
    const std::optional<LocalIndex> item = take_item();
    send(from, item ? std::int64_t{*item} : kNothingLeft);
  } else if (request == kWantStop) {
    stop_all();
  } else {
    ++num_finished_;
  }
}

void WorkQueue::accept(std::int64_t answer)
{
  if (answer == kStop)
    stop_requested_ = true;
  else if (answer == kAllFinished)
    finished_ = true;
  else
    answer_ = answer;
}

void WorkQueue::stop_all()
{
  if (std::exchange(stop_requested_, true)) return;
  // Messages between two ranks keep their order, so this one is read before kAllFinished.
  for (Rank to = 1; to < communicator_.size(); ++to) send(to, kStop);
}

std::optional<LocalIndex> WorkQueue::take_item()
{
  if (stop_requested_ || num_handed_out_ == order_.size()) return std::nullopt;
  return order_[num_handed_out_++];
}

}  // namespace tessera::comm
