// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/jobs/job_runner.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "jobs/call.hpp"
#include "jobs/child_process.hpp"
#include "jobs/node_socket.hpp"
#include "jobs/zygote.hpp"
#include "jobs/zygote_link.hpp"

namespace tessera::jobs {
namespace {

[[noreturn]] void throw_system_error(const char* what)
{
  throw Error(fmt::format("cannot start the worker process: {}: {}", what, std::strerror(errno)));
}

std::pair<FileDescriptor, FileDescriptor> make_socket_pair()
{
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw_system_error("socketpair");
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

JobLimits smaller_of(const JobLimits& a, const JobLimits& b)
{
  return {.cpu_s = std::min(a.cpu_s, b.cpu_s),
          .stall_s = std::min(a.stall_s, b.stall_s),
          .memory_gib = std::min(a.memory_gib, b.memory_gib),
          .idle_cpu_s = a.idle_cpu_s,
          .is_alone = a.is_alone};
}

// A load that breaks a limit is ended by the rank whose model zygote it is, which can say why. Only
// if that does nothing do others.
JobLimits with_patience(JobLimits limits)
{
  constexpr double kPatience_s = 5.0;
  limits.cpu_s += kPatience_s;
  limits.stall_s += kPatience_s;
  limits.memory_gib *= 1.1;
  return limits;
}

}  // namespace

struct JobRunner::State {
  ZygoteLink link{};
  std::optional<JobLimits> largest{};
  double cpu_s = 0.0;                  // Since the last restart_usage(), as link.peak_bytes.
  std::size_t earlier_peak_bytes = 0;  // Before it.

  JobOutcome call(PacketKind kind, std::span<const std::byte> message, JobLimits limits,
                  const WaitCallback& on_wait)
  {
    if (largest) limits = smaller_of(limits, *largest);
    if (link.has_joined() && kind == PacketKind::load) limits = with_patience(limits);
    JobOutcome outcome = Call(link, kind, message, limits, on_wait).wait();
    cpu_s += outcome.cpu_s;
    return outcome;
  }
};

JobRunner::JobRunner(const std::function<std::unique_ptr<Worker>()>& make_worker)
    : state_(std::make_unique<State>())
{
  ZygoteLink& link = state_->link;
  ZygoteSockets sockets;
  std::tie(link.control, sockets.control) = make_socket_pair();
  std::tie(link.data, sockets.data) = make_socket_pair();

  flush_streams();
  const pid_t rank_process = ::getpid();
  link.zygote = ::fork();
  if (link.zygote < 0) throw_system_error("fork");
  if (link.zygote == 0) run_zygote(rank_process, std::move(sockets), make_worker);
  link.start_model();
}

JobRunner::~JobRunner()
{
  ZygoteLink& link = state_->link;
  link.control.close();
  link.data.close();
  while (::waitpid(link.zygote, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void JobRunner::set_log_file(const std::filesystem::path& file)
{
  // The worker processes keep the working directory of the time when they were forked.
  state_->link.settings.log_file = std::filesystem::absolute(file).string();
  state_->link.settings_are_told = false;
}

void JobRunner::set_node(int num_ranks, std::vector<int> cores)
{
  state_->link.settings.num_ranks_of_node = num_ranks;
  state_->link.settings.cores_of_node = std::move(cores);
  state_->link.settings_are_told = false;
}

void JobRunner::prepare()
{
  const ZygoteLink& link = state_->link;
  if (!link.has_joined()) send_signal(link.data.get(), PacketKind::prepare, link.num_calls);
}

void JobRunner::cap_limits(const JobLimits& largest) { state_->largest = largest; }

std::string JobRunner::open_to_node()
{
  // With what it has loaded: all begin alike.
  if (state_->link.num_calls > 0) state_->link.end_model();
  std::string name = make_node_name();
  const JobOutcome outcome =
      state_->call(PacketKind::open_door, std::as_bytes(std::span(name)), {}, {});
  throw_unless_ok(outcome, "cannot listen for ranks of this node");
  state_->link.is_open = true;
  return name;
}

void JobRunner::close_to_node()
{
  throw_unless_ok(state_->call(PacketKind::open_door, {}, {}, {}), "cannot stop listening");
}

void JobRunner::join(const std::string& name) { state_->link.join(name); }

void JobRunner::leave_node()
{
  state_->link.leave();
  // Its loads were numbered for all; a fresh one begins anew.
  if (std::exchange(state_->link.is_open, false)) state_->link.end_model();
}

JobOutcome JobRunner::load(std::span<const std::byte> message, const JobLimits& limits,
                           const WaitCallback& on_wait)
{
  return state_->call(PacketKind::load, message, limits, on_wait);
}

JobOutcome JobRunner::run(std::span<const std::byte> request, const JobLimits& limits,
                          const WaitCallback& on_wait)
{
  return state_->call(PacketKind::run, request, limits, on_wait);
}

std::size_t JobRunner::peak_rss_bytes() const
{
  return std::max(state_->earlier_peak_bytes, state_->link.peak_bytes);
}

JobUsage JobRunner::usage() const
{
  return {state_->cpu_s, state_->link.peak_bytes, state_->link.loaded_bytes};
}

void JobRunner::restart_usage()
{
  state_->earlier_peak_bytes = peak_rss_bytes();
  state_->link.peak_bytes = 0;
  state_->cpu_s = 0.0;
}

}  // namespace tessera::jobs
