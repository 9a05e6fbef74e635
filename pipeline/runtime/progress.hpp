// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <spdlog/logger.h>

namespace tessera::pipeline {

/// @brief Tells people how far a run is: a bar on a terminal, plain lines elsewhere. Rank 0 speaks;
/// on other ranks all calls do nothing.
class Progress {
 public:
  enum class Style : int { silent, lines, bar };

  Progress(Style style, std::shared_ptr<spdlog::logger> log);

  /// @brief Begins a stage of `total` units of work (0: unknown), e.g. "subdomains".
  void begin(const std::string& stage, std::int64_t total, const std::string& unit);

  /// @brief Says how much is done. On a terminal it prints at most a few times a second. In a log
  /// it prints at every tenth of the work, but not more often than every 10 s.
  void update(std::int64_t done);

  /// @brief Ends the stage with one line: its time, and `summary` if there is one.
  void end(const std::string& summary);

  /// @brief Removes a bar in the middle of a stage, before an error message.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double elapsed_s() const;
  [[nodiscard]] std::string rate_and_rest(std::int64_t done) const;
  void draw_bar(std::int64_t done);

  Style style_;
  std::shared_ptr<spdlog::logger> log_;
  std::string stage_{};
  std::string unit_{};
  std::int64_t total_ = 0;
  std::int64_t last_tenth_ = 0;
  Clock::time_point start_{};
  Clock::time_point last_output_{};
  bool bar_is_drawn_ = false;
};

}  // namespace tessera::pipeline
