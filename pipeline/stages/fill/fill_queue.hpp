// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/task_board.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {

/// @brief What the tries at one range of subdomains have given so far.
struct FillTries {
  LocalIndex count = 0;
  bool was_limited = false;
  bool is_made = false;  ///< There is a result.
  double angle_to_beat_deg = kAnyAngle;
  std::vector<std::string> failures{};
  Rank holder = 0;  ///< Who has the result.

  static auto fields(auto& self)
  {
    return std::tie(self.count, self.was_limited, self.is_made, self.angle_to_beat_deg,
                    self.failures, self.holder);
  }
};

/// @brief One try that a rank gets; bytes of it are comm::Task::more.
struct FillOrder {
  LocalIndex range = 0;
  LocalIndex number = 0;  ///< Of the try, from 0.
  bool is_probe = false;  ///< Its turn has not come: find out whether it fails, and keep nothing.
  FillTries before{};

  static auto fields(auto& self)
  {
    return std::tie(self.range, self.number, self.is_probe, self.before);
  }
};

/// @brief How a try has ended; bytes of it are its verdict.
struct FillVerdict {
  jobs::JobEnd end{};    ///< Of its job.
  bool is_poor = false;  ///< One more try may give a better result.
  double angle_deg = kAnyAngle;

  [[nodiscard]] bool is_made() const { return end.status == jobs::JobStatus::ok; }

  static auto fields(auto& self) { return std::tie(self.end, self.is_poor, self.angle_deg); }
};

/// @brief The tries at all ranges. A rank without work gets the next try of a range that is begun,
/// else a new range. At the end, when all are begun, it gets a *probe*: a later try of a range
/// whose earlier tries are still at work or have failed.
///
/// A probe that fails takes the place of the try, since it would fail again: a try is a pure
/// function. One that does not fail is made once more when its turn has come, and then kept. So the
/// same try counts for any number of ranks, and nobody waits for several failures in turn.
class FillQueue final : public comm::TaskSource {
 public:
  /// @param order   Ranges in the order in which they are begun.
  /// @param kernels Of each range those of its tries, in their order.
  /// @param seconds A clock.
  FillQueue(std::vector<LocalIndex> order, std::vector<std::vector<fill::KernelKind>> kernels,
            std::function<double()> seconds);

  [[nodiscard]] std::optional<comm::Task> next() override;
  void ended(LocalIndex item, const Bytes& verdict, Rank rank) override;
  void dropped(LocalIndex item) override;
  [[nodiscard]] bool is_needed(LocalIndex item) const override;
  [[nodiscard]] bool is_settled() const override;

  /// @brief A range of which all tries have failed; that settles it.
  [[nodiscard]] std::optional<LocalIndex> hopeless() const { return hopeless_; }

  /// @brief Of all ranges, by number.
  [[nodiscard]] std::vector<FillTries> tries() const;
  [[nodiscard]] std::int64_t num_begun() const { return static_cast<std::int64_t>(num_begun_); }

 private:
  struct Range {
    std::vector<fill::KernelKind> kernels{};
    FillTries tries{};
    std::size_t current = 0;  ///< The try whose turn it is.
    std::size_t place = 0;    ///< In the order.
    bool is_done = false;
    double start_s = 0.0;                  ///< When it was begun.
    std::map<LocalIndex, bool> at_work{};  ///< Tries, and whether they are probes.
    std::map<LocalIndex, FillVerdict> probed{};
  };

  [[nodiscard]] LocalIndex item_of(LocalIndex range, std::size_t number) const;
  [[nodiscard]] comm::Task start(LocalIndex range, std::size_t number, bool is_probe);
  [[nodiscard]] std::optional<comm::Task> next_try();
  [[nodiscard]] std::optional<comm::Task> next_probe();
  static std::optional<std::size_t> probe_of(const Range& range);
  static void take(Range& range, const FillVerdict& verdict, Rank rank);
  static void take_failed_probes(Range& range);

  std::vector<LocalIndex> order_;
  std::size_t num_begun_ = 0;       ///< The first ones in order.
  std::set<std::size_t> active_{};  ///< Begun and not done: places in the order.
  std::vector<Range> ranges_{};
  std::function<double()> seconds_;
  LocalIndex most_tries_ = 1;
  std::size_t num_done_ = 0;
  std::optional<LocalIndex> hopeless_{};
};

}  // namespace tessera::pipeline
