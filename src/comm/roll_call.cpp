// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/roll_call.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <list>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"
#include "tessera/base/types.hpp"

namespace tessera::comm {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// As in Communicator::quiet_barrier().
constexpr std::chrono::milliseconds kBetweenLooks{1};
constexpr int kFirstLooks = 10;

// What the others have to answer, once one has given up: each looks every millisecond.
constexpr Seconds kAnswerTime{3.0};

std::optional<FailedRollCall>& first_failure()
{
  static std::optional<FailedRollCall> failure;
  return failure;
}

// Of one communicator, kept by MPI as long as that.
struct Record {
  std::int64_t num_calls = 0;
  std::string failure{};
};

int delete_record(MPI_Comm /*ranks*/, int /*key*/, void* record, void* /*extra*/)
{
  delete static_cast<Record*>(record);
  return MPI_SUCCESS;
}

Record& record_of(MPI_Comm ranks)
{
  static const int key = [] {
    int made = MPI_KEYVAL_INVALID;
    MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, delete_record, &made, nullptr);
    return made;
  }();
  void* record = nullptr;
  int is_there = 0;
  MPI_Comm_get_attr(ranks, key, static_cast<void*>(&record), &is_there);
  if (is_there != 0) return *static_cast<Record*>(record);
  auto* const made = new Record;  // delete_record() deletes it.
  MPI_Comm_set_attr(ranks, key, made);
  return *made;
}

class RollCall {
 public:
  RollCall(MPI_Comm ranks, std::int64_t number) : ranks_(ranks), number_(number)
  {
    MPI_Comm_rank(ranks, &rank_);
    MPI_Comm_size(ranks, &size_);
    there_.insert(rank_);
  }

  // Whether all ranks come. Giving up is not final until the others had time to answer: whoever
  // comes before he hears of it comes in time, and then the barrier ends on all of them.
  [[nodiscard]] bool all_come(double timeout_s)
  {
    // One look may miss a message that lies in the socket since before this rank called MPI.
    for (int look = 0; look < kFirstLooks; ++look) {
      listen();
      std::this_thread::sleep_for(kBetweenLooks);
    }
    is_late_ = there_.size() > 1;
    if (is_late_) return false;  // The others leave, so this rank must not enter.
    MPI_Ibarrier(ranks_, &barrier_);
    if (ends_within(Seconds(timeout_s), [&] { return there_.size() > 1; })) return true;
    tell_others();
    return ends_within(kAnswerTime, [] { return false; });
  }

  [[nodiscard]] FailedRollCall failure(const std::string& function) const
  {
    const std::string all = "; every rank of the communicator must call it";
    // With all of them there, somebody has left before he could know.
    if (is_late_ || there_.size() == at(size_)) {
      return {fmt::format("{}: rank {} of {} has called it when others no longer waited{}",
                          function, rank_, size_, all)};
    }
    return {fmt::format("{}: {} not called it in {:.1f} s{}", function, missing_ranks(),
                        Seconds(Clock::now() - begin_).count(), all),
            *there_.begin() == rank_};
  }

 private:
  // Whether the barrier ends before the time is over, or `is_enough` says so.
  template <class IsEnough>
  [[nodiscard]] bool ends_within(Seconds time, const IsEnough& is_enough)
  {
    for (const auto begin = Clock::now();; std::this_thread::sleep_for(kBetweenLooks)) {
      int is_over = 0;
      MPI_Test(&barrier_, &is_over, MPI_STATUS_IGNORE);
      if (is_over != 0) return true;
      listen();
      if (Clock::now() - begin > time || is_enough()) return false;
    }
  }

  // Who has given up is there. Calls before this one may have left messages, where the last rank
  // came just in time.
  void listen()
  {
    while (true) {
      int is_there = 0;
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, kRollCallTag, ranks_, &is_there, &status);
      if (is_there == 0) return;
      std::int64_t number = 0;
      MPI_Recv(&number, 1, MPI_INT64_T, status.MPI_SOURCE, kRollCallTag, ranks_, MPI_STATUS_IGNORE);
      if (number == number_) there_.insert(status.MPI_SOURCE);
    }
  }

  // Those that are missing too, for they may come. Nobody waits for these messages to be received.
  void tell_others() const
  {
    static std::list<std::int64_t> sent;
    const std::int64_t& number = sent.emplace_back(number_);
    for (Rank to = 0; to < size_; ++to) {
      if (to == rank_) continue;
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Isend(&number, 1, MPI_INT64_T, to, kRollCallTag, ranks_, &request);
      MPI_Request_free(&request);
    }
  }

  // "rank 1 of 4 has", "ranks 0, 2 of 4 have", "ranks 1, 2, …, and 93 more of 104 have"
  [[nodiscard]] std::string missing_ranks() const
  {
    constexpr std::size_t kMostNamed = 10;
    std::vector<Rank> missing;
    for (Rank rank = 0; rank < size_; ++rank) {
      if (!there_.contains(rank)) missing.push_back(rank);
    }
    const std::size_t num_named = std::min(missing.size(), kMostNamed);
    const std::string more = num_named == missing.size()
                                 ? std::string()
                                 : fmt::format(", and {} more", missing.size() - num_named);
    const bool is_one = missing.size() == 1;
    missing.resize(num_named);
    return fmt::format("{} {}{} of {} {}", is_one ? "rank" : "ranks", fmt::join(missing, ", "),
                       more, size_, is_one ? "has" : "have");
  }

  MPI_Comm ranks_;
  std::int64_t number_;
  Rank rank_ = 0;
  int size_ = 1;
  Clock::time_point begin_ = Clock::now();
  MPI_Request barrier_ = MPI_REQUEST_NULL;  // Abandoned if it does not end: MPI cannot cancel it.
  std::set<Rank> there_{};
  bool is_late_ = false;
};

}  // namespace

void roll_call(MPI_Comm ranks, const std::string& function, double timeout_s)
{
  Record& record = record_of(ranks);
  if (!record.failure.empty()) throw UsageError(record.failure);
  RollCall call(ranks, ++record.num_calls);
  if (call.all_come(timeout_s)) return;
  FailedRollCall failure = call.failure(function);
  record.failure = failure.message;
  if (!first_failure()) first_failure() = std::move(failure);
  throw UsageError(record.failure);
}

const std::optional<FailedRollCall>& failed_roll_call() { return first_failure(); }

}  // namespace tessera::comm
