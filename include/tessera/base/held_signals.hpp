// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <initializer_list>
#include <utility>
#include <vector>

#include <pthread.h>

namespace tessera {

/// @brief Holds signals back from the calling thread as long as it lives. At its end their handlers
/// are again what they were, and what came meanwhile is delivered. Threads that start meanwhile
/// never get these signals.
class HeldSignals {
 public:
  HeldSignals(std::initializer_list<int> signals)
  {
    sigset_t held;
    ::sigemptyset(&held);
    for (const int signal : signals) {
      ::sigaddset(&held, signal);
      struct sigaction action {};
      ::sigaction(signal, nullptr, &action);
      actions_.emplace_back(signal, action);
    }
    ::pthread_sigmask(SIG_BLOCK, &held, &mask_);
  }
  ~HeldSignals()
  {
    for (const auto& [signal, action] : actions_) ::sigaction(signal, &action, nullptr);
    ::pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  std::vector<std::pair<int, struct sigaction>> actions_{};
  sigset_t mask_{};
};

}  // namespace tessera
