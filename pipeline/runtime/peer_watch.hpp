// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tessera::pipeline {

/// @brief When a peer is lost.
struct PeerLimits {
  std::chrono::milliseconds look{5'000};  ///< Between two looks at all connections.
  /// Nothing has come for so long, though it was asked for. Longer than a switch needs to start
  /// again, and short enough for an end within two minutes, with what MPI adds.
  std::chrono::milliseconds silence{60'000};
};

/// @brief Looks at the TCP connections of this process, from a thread of its own, and says once
/// that a peer is lost: a node that is off, or that the network does not reach.
///
/// MPI waits for such a peer for ever: a connection on which nothing is to be sent never fails, and
/// the kernel tries for a quarter of an hour to send what it has. A slow or stopped peer is not
/// lost, for its kernel answers. Networks other than TCP find out by themselves.
///
/// @pre All connections of the process are those of MPI, which keeps them to its end. So one
/// that is gone means a peer that is.
class PeerWatch {
 public:
  /// @param on_lost is called in the thread, with one sentence.
  explicit PeerWatch(std::function<void(const std::string&)> on_lost, PeerLimits limits = {});
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

 private:
  void run(const PeerLimits& limits);

  std::function<void(const std::string&)> on_lost_;
  std::mutex mutex_{};
  std::condition_variable ended_{};
  bool is_over_ = false;
  std::thread thread_{};
};

/// @brief What the program does about a lost peer: says so, and ends this process with
/// ExitCode::stopped. The launcher of MPI ends the others.
[[noreturn]] void end_without_peer(const std::string& sentence);

}  // namespace tessera::pipeline
