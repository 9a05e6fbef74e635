// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/task_board.hpp"

namespace tessera::pipeline {

/// @brief How a rung has ended: the verdict of its surface.
enum class RungEnd : int {
  failed,   ///< The next rung follows.
  final,    ///< No other rung could be better: it is the run's end.
  surface,  ///< There is a surface; it can be filled.
};
[[nodiscard]] constexpr RungEnd last_value(RungEnd /*type*/) { return RungEnd::surface; }

/// @brief The tries at the coarse surface, best first: which of them counts, and which of them idle
/// ranks begin before their turn has come.
///
/// The *front* is the first rung that is still needed, as if all were tried in turn. What it is
/// depends on how rungs have ended only, not on when. So the same rung wins for any number of
/// ranks.
class CoarseLadder final : public comm::TaskSource {
 public:
  /// @param seconds A clock.
  /// @param head_start_s How long the first rung runs before others are begun, seconds.
  CoarseLadder(std::size_t num_rungs, std::function<double()> seconds, double head_start_s);

  /// @brief The front. Once it has run for some seconds, or a rung has failed, also those behind
  /// it.
  [[nodiscard]] std::optional<comm::Task> next() override;
  /// @param verdict Bytes of a RungEnd.
  void ended(LocalIndex rung, const Bytes& verdict, Rank rank) override;
  void dropped(LocalIndex rung) override;
  [[nodiscard]] bool is_needed(LocalIndex rung) const override;
  [[nodiscard]] bool is_settled() const override;

  /// @brief The surface of a rung could not be filled.
  void fill_has_failed(LocalIndex rung);

  /// @brief The front: once it is settled, the rung that counts. Nothing if all have failed.
  [[nodiscard]] std::optional<LocalIndex> front() const;

  /// @brief The rungs before the front that were tried and failed, in order.
  [[nodiscard]] std::vector<LocalIndex> failed() const;

  /// @brief What ended() and the others have told, for restore() on another rank.
  [[nodiscard]] std::vector<LocalIndex> snapshot() const;
  void restore(const std::vector<LocalIndex>& snapshot);

  /// @brief Which rank has the surface of a rung.
  [[nodiscard]] Rank holder(LocalIndex rung) const { return rungs_[at(rung)].holder; }

 private:
  enum class State { waiting, running, failed, final, surface };
  struct Rung {
    State state = State::waiting;
    Rank holder = 0;
  };

  [[nodiscard]] static bool is_decided(const Rung& rung)
  {
    return rung.state == State::surface || rung.state == State::final;
  }
  [[nodiscard]] std::size_t first_not_failed() const;
  [[nodiscard]] std::size_t first_decided() const;

  std::vector<Rung> rungs_;
  std::function<double()> seconds_;
  double head_start_s_;
  double first_start_s_ = 0.0;  // Of the first rung.
};

}  // namespace tessera::pipeline
