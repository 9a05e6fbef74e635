// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief A piece of work that a rank gets.
struct Task {
  LocalIndex item = 0;
  Bytes more{};  ///< What else its worker must know.

  static auto fields(auto& self) { return std::tie(self.item, self.more); }
};

/// @brief Decides what ranks without work are to do; rank 0 asks it. Unlike the list of a WorkQueue
/// it may depend on how earlier items have ended, and may no longer need an item that somebody
/// works on. An item is with one worker at most.
class TaskSource {
 public:
  virtual ~TaskSource() = default;

  /// @brief Something for a rank that has nothing to do; nothing: none for now.
  [[nodiscard]] virtual std::optional<Task> next() = 0;

  /// @brief An item of next() has ended on this rank, which says this about it.
  virtual void ended(LocalIndex item, const Bytes& verdict, Rank rank) = 0;

  /// @brief An item of next() was given up before it ended: it was not needed.
  virtual void dropped(LocalIndex item) = 0;

  /// @brief Whether an item that somebody works on is still needed.
  [[nodiscard]] virtual bool is_needed(LocalIndex item) const = 0;

  /// @brief Whether all is decided.
  [[nodiscard]] virtual bool is_settled() const = 0;
};

/// @brief Ranks work on what a TaskSource on rank 0 wants, until it is settled.
///
/// Rank 0 works too, and serves the others whenever its work calls `on_wait`, which must be every
/// few milliseconds. Own code with two-sided messages, for the reasons of WorkQueue.
class TaskBoard {
 public:
  /// @brief Works on a task and returns its verdict. Must not throw. When `on_wait` returns false
  /// the item is no longer needed: return soon, whatever.
  using Work = std::function<Bytes(const Task& task, const std::function<bool()>& on_wait)>;

  /// @param source That of rank 0 counts. Borrowed.
  /// @note Collective.
  TaskBoard(const Communicator& communicator, TaskSource& source);
  TaskBoard(const TaskBoard&) = delete;
  TaskBoard& operator=(const TaskBoard&) = delete;

  /// @brief Until the source is settled, and all ranks have ended their work.
  /// @param is_stopped Looked at all the time; true on any rank ends it for all, settled or not.
  /// @note Collective; once.
  void run(const Work& work, const std::function<bool()>& is_stopped);

 private:
  enum class Kind : std::int64_t { want, ended, dropped, stop, task, cancel, done };
  struct Note {
    std::int64_t kind = 0;
    Task task{};

    static auto fields(auto& self) { return std::tie(self.kind, self.task); }
  };
  struct PendingSend {
    Bytes bytes{};
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void run_root(const Work& work);
  void run_other(const Work& work);
  void look_for_stop();
  void send(Rank to, Kind kind, Task task = {});
  void progress();
  void serve(Rank from, Kind kind, const Task& task);
  void accept(Kind kind, Task task);
  void accept_cancel(LocalIndex item);
  void cancel_unneeded();
  void hand_out();
  [[nodiscard]] bool is_over() const { return stopped_ || source_.is_settled(); }

  Communicator communicator_;
  TaskSource& source_;
  std::function<bool()> asks_to_stop_{};
  bool stopped_ = false;

  // Rank 0.
  std::set<Rank> waiting_{};
  std::map<Rank, LocalIndex> busy_{};
  std::set<Rank> cancelled_{};
  int num_done_ = 0;

  // Other ranks.
  std::optional<Task> given_{};
  std::optional<LocalIndex> own_{};
  bool own_is_cancelled_ = false;
  bool is_done_ = false;

  std::list<PendingSend> sends_{};
};

}  // namespace tessera::comm
