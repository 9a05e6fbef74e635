// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <exception>
#include <optional>
#include <span>
#include <string>

#include "tessera/base/repair.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "jobs/packet.hpp"
#include "jobs/watch.hpp"
#include "jobs/zygote_link.hpp"

namespace tessera::jobs {

/// @brief One load or job, seen from the rank. It sends the request, watches the process that works
/// on it, and collects the outcome. It kills the process if that breaks a limit or the caller asks
/// to stop.
///
/// Limits are watched only here. To kill a process its parent is asked: the parent alone knows for
/// sure that the process number is still that of its child.
class Call {
 public:
  /// @pre kind is open_door, load or run; all arguments outlive the call.
  Call(ZygoteLink& link, PacketKind kind, std::span<const std::byte> message,
       const JobLimits& limits, const JobRunner::WaitCallback& on_wait);

  /// @brief Blocks until the outcome is known. Rethrows what `on_wait` throws, after the kill.
  [[nodiscard]] JobOutcome wait();

 private:
  using Clock = std::chrono::steady_clock;
  enum class Target { job, model, zygote };

  void wait_for_packets();
  void send_request();
  void send_kill();
  void receive_data();
  void receive_control();
  void accept_data(const Packet& packet);
  void accept_answer(const Packet& packet);
  void accept_control(const Packet& packet);
  void tick(Clock::time_point now);
  [[nodiscard]] std::optional<JobStatus> reason_to_kill(double since_last_tick_s);
  void kill(Target target, Clock::time_point now);

  void finish(JobEnd end);
  void finish_lost();
  void finish_ended(const ProcessEnd& end, bool is_model);
  void finish_answered();
  void note_usage(const ProcessEnd& end);
  [[nodiscard]] std::string killed_message(JobStatus reason) const;

  ZygoteLink& link_;
  PacketKind kind_;
  const JobLimits& limits_;
  const JobRunner::WaitCallback& on_wait_;
  std::uint32_t number_;
  Bytes settings_;
  Outgoing settings_request_;
  Outgoing request_;

  Clock::time_point start_;
  Clock::time_point last_tick_;
  std::optional<Watch> watch_{};  // nothing until the process to watch is known
  pid_t watched_ = 0;
  pid_t job_ = 0;

  std::optional<JobStatus> kill_reason_{};
  Target killed_ = Target::job;
  bool kill_sent_ = false;
  Clock::time_point kill_time_{};
  std::exception_ptr thrown_{};

  Assembly answer_{};
  bool answered_ = false;
  std::optional<UsageReport> usage_{};
  RepairCounts repairs_{};  // That the job noted.
  std::optional<JobOutcome> outcome_{};
};

}  // namespace tessera::jobs
