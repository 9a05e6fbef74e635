// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/task_board.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace tessera::comm {
namespace {

constexpr int kTag = 2;

// As in WorkQueue: short against a job, long against a look at the messages.
void rest() { std::this_thread::sleep_for(std::chrono::microseconds(500)); }

}  // namespace

TaskBoard::TaskBoard(const Communicator& communicator, TaskSource& source)
    : communicator_(communicator.handle()), source_(source)
{
}

void TaskBoard::run(const Work& work, const std::function<bool()>& is_stopped)
{
  asks_to_stop_ = is_stopped;
  communicator_.rank() == 0 ? run_root(work) : run_other(work);
  for (progress(); !sends_.empty(); progress()) rest();
}

void TaskBoard::run_root(const Work& work)
{
  for (progress(); !is_over() || num_done_ < communicator_.size() - 1; progress()) {
    const std::optional<Task> task = is_over() ? std::nullopt : source_.next();
    if (!task) {
      rest();
      continue;
    }
    bool is_cancelled = false;
    const auto on_wait = [&] {
      progress();
      is_cancelled = is_cancelled || is_over() || !source_.is_needed(task->item);
      return !is_cancelled;
    };
    const Bytes verdict = work(*task, on_wait);
    is_cancelled ? source_.dropped(task->item) : source_.ended(task->item, verdict, 0);
  }
}

// Every task is answered by ended or dropped, and then a new one is wanted. What rank 0 sends keeps
// its order, so a late cancel is read before the next task and names one that is over.
void TaskBoard::run_other(const Work& work)
{
  send(0, Kind::want);
  for (progress(); !is_done_; progress()) {
    if (!given_) {
      rest();
      continue;
    }
    const Task task = std::move(*given_);
    given_.reset();
    own_ = task.item;
    own_is_cancelled_ = stopped_;
    const auto on_wait = [&] {
      progress();
      return !own_is_cancelled_;
    };
    Bytes verdict = work(task, on_wait);
    own_.reset();
    send(0, own_is_cancelled_ ? Kind::dropped : Kind::ended, {task.item, std::move(verdict)});
    send(0, Kind::want);
  }
}

void TaskBoard::look_for_stop()
{
  if (stopped_ || is_done_ || !asks_to_stop_()) return;
  stopped_ = true;
  if (communicator_.rank() == 0) return;
  own_is_cancelled_ = true;
  send(0, Kind::stop);
}

void TaskBoard::send(Rank to, Kind kind, Task task)
{
  PendingSend& pending = sends_.emplace_back();
  pending.bytes = to_bytes(Note{static_cast<std::int64_t>(kind), std::move(task)});
  MPI_Isend(pending.bytes.data(), static_cast<int>(pending.bytes.size()), MPI_BYTE, to, kTag,
            communicator_.handle(), &pending.request);
}

void TaskBoard::progress()
{
  look_for_stop();
  sends_.remove_if([](PendingSend& pending) {
    int done = 0;
    MPI_Test(&pending.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  const bool is_root = communicator_.rank() == 0;
  const Rank source = is_root ? MPI_ANY_SOURCE : 0;
  for (;;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(source, kTag, communicator_.handle(), &there, &status);
    if (there == 0) break;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Bytes bytes(static_cast<std::size_t>(size));
    MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, kTag, communicator_.handle(),
             MPI_STATUS_IGNORE);
    Note note = from_bytes<Note>(bytes);
    const Kind kind{note.kind};
    is_root ? serve(status.MPI_SOURCE, kind, note.task) : accept(kind, std::move(note.task));
  }
  if (!is_root) return;
  cancel_unneeded();
  hand_out();
}

void TaskBoard::serve(Rank from, Kind kind, const Task& task)
{
  if (kind == Kind::want) waiting_.insert(from);
  if (kind == Kind::stop) stopped_ = true;
  if (kind != Kind::ended && kind != Kind::dropped) return;
  busy_.erase(from);
  cancelled_.erase(from);
  kind == Kind::ended ? source_.ended(task.item, task.more, from) : source_.dropped(task.item);
}

void TaskBoard::accept(Kind kind, Task task)
{
  if (kind == Kind::task) given_ = std::move(task);
  if (kind == Kind::done) is_done_ = true;
  if (kind == Kind::cancel) accept_cancel(task.item);
}

void TaskBoard::accept_cancel(LocalIndex item)
{
  if (own_ && *own_ == item) own_is_cancelled_ = true;
  if (!given_ || given_->item != item) return;
  given_.reset();  // It came with the task.
  send(0, Kind::dropped, {.item = item});
  send(0, Kind::want);
}

void TaskBoard::cancel_unneeded()
{
  for (const auto& [rank, item] : busy_) {
    if (!is_over() && source_.is_needed(item)) continue;
    if (!cancelled_.insert(rank).second) continue;
    send(rank, Kind::cancel, {.item = item});
  }
}

void TaskBoard::hand_out()
{
  while (!waiting_.empty()) {
    std::optional<Task> task = is_over() ? std::nullopt : source_.next();
    if (!task && !is_over()) return;
    const Rank to = *waiting_.begin();
    waiting_.erase(to);
    if (task) {
      busy_[to] = task->item;
      send(to, Kind::task, std::move(*task));
    } else {
      ++num_done_;
      send(to, Kind::done);
    }
  }
}

}  // namespace tessera::comm
