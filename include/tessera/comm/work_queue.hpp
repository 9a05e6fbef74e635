// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief Hands every item of a list to exactly one rank, to whoever asks next.
///
/// Rank 0 keeps the list and works on items itself. It serves the others whenever it calls
/// progress(), so it must call that every few milliseconds while it waits for its own job. Own code
/// with two-sided messages, because a shared counter (MPI_Fetch_and_op) stalls while its owner
/// sleeps.
///
/// Every rank: `while (const auto item = queue.next()) work(*item); queue.finish();`
class WorkQueue {
 public:
  /// @param order Items in the order in which they are handed out; that of rank 0 counts.
  /// @note Collective.
  WorkQueue(const Communicator& communicator, std::vector<LocalIndex> order);

  /// @brief finish(), also when an exception unwinds: ranks that are still at work are served.
  ~WorkQueue();
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  /// @brief An item that nobody else gets; nothing when none is left or a stop was requested.
  /// @note Local; waits for rank 0, asleep between looks.
  /// @pre finish() was not called.
  [[nodiscard]] std::optional<LocalIndex> next();

  /// @brief Passes messages on; cheap. Call it every few milliseconds while working on an item.
  /// @note Local.
  /// @return False when a rank requested a stop: cancel the item at hand.
  bool progress();

  /// @brief Items handed out so far, on rank 0; 0 elsewhere. Local.
  [[nodiscard]] std::int64_t num_handed_out() const
  {
    return static_cast<std::int64_t>(num_handed_out_);
  }

  /// @brief Asks all ranks to stop: no further item is handed out to anybody. Local.
  void request_stop();

  /// @brief Waits until every rank is here; rank 0 serves the others meanwhile.
  /// @note Collective. A second call returns the same at once.
  /// @return On every rank the same: was a stop requested by any rank?
  bool finish();

 private:
  struct PendingSend {
    std::int64_t value = 0;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void send(Rank to, std::int64_t value);
  void serve(Rank from, std::int64_t request);
  void accept(std::int64_t answer);
  void stop_all();
  [[nodiscard]] std::optional<LocalIndex> take_item();

  Communicator communicator_;
  std::vector<LocalIndex> order_;         // rank 0: the items; other ranks: unused
  std::size_t num_handed_out_ = 0;        // rank 0
  int num_finished_ = 0;                  // rank 0: other ranks that called finish()
  std::optional<std::int64_t> answer_{};  // other ranks: to the last request
  bool stop_requested_ = false;
  bool finished_ = false;
  std::list<PendingSend> sends_{};
};

}  // namespace tessera::comm
