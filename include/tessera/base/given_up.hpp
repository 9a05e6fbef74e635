// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Says what was given up and why, on standard error: that is the log of a job. For errors
/// that are none, because there is another way. Local.
void note_given_up(std::string_view what, const std::exception& why);

/// @brief The same for what is tried many times: at its end it says how often that was given up,
/// and why at first. All functions are local.
class Attempts {
 public:
  explicit Attempts(std::string_view what) : what_(what) {}
  ~Attempts();
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;

  /// @brief What `work` returns; nothing if it throws an `Expected`.
  template <class Expected, class Work>
  [[nodiscard]] auto run(const Work& work) -> std::optional<decltype(work())>
  {
    try {
      return work();
    } catch (const Expected& error) {
      note(error);
      return std::nullopt;
    }
  }

 private:
  void note(const std::exception& why);

  std::string what_;
  std::string first_reason_{};
  GlobalIndex num_given_up_ = 0;
};

}  // namespace tessera
