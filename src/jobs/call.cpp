// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/call.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>

namespace tessera::jobs {
namespace {

// How often the caller is asked and the limits are looked at. A look costs 10 µs of CPU time
// (measured).
constexpr std::chrono::milliseconds kTick{4};

// A process that is to be killed ends within milliseconds. If nothing is heard of it for this long,
// its parent is stopped or broken, and the parent's parent is asked.
constexpr std::chrono::seconds kPatience{5};
// A model zygote that other ranks use is ended with more care.
constexpr std::chrono::seconds kPatienceIfShared{60};

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to)
{
  return std::chrono::duration<double>(to - from).count();
}

std::string signal_message(int signal)
{
  std::string text = fmt::format("ended by signal {} ({})", signal, ::strsignal(signal));
  if (signal != SIGKILL) return text;
  return text + " from outside: by hand, or because the system ran out of memory";
}

}  // namespace

Call::Call(ZygoteLink& link, PacketKind kind, std::span<const std::byte> message,
           const JobLimits& limits, const JobRunner::WaitCallback& on_wait)
    : link_(link),
      kind_(kind),
      limits_(limits),
      on_wait_(on_wait),
      number_(++link.num_calls),
      settings_(to_bytes(link.settings)),
      settings_request_(PacketKind::settings, number_, settings_),
      request_(kind == PacketKind::run && limits.is_alone ? PacketKind::run_alone : kind, number_,
               message),
      start_(Clock::now()),
      last_tick_(start_)
{
}

JobOutcome Call::wait()
{
  receive_control();
  if (!outcome_ && !link_.model_was_started) link_.start_model();
  while (!outcome_) {
    kill_reason_ ? send_kill() : send_request();
    wait_for_packets();
    receive_data();
    receive_control();
    const Clock::time_point now = Clock::now();
    if (!outcome_ && now - last_tick_ >= kTick) tick(now);
  }
  if (thrown_) std::rethrow_exception(thrown_);
  outcome_->wall_s = seconds_between(start_, Clock::now());
  return std::move(*outcome_);
}

void Call::wait_for_packets()
{
  const bool sending = kill_reason_ ? !kill_sent_ : !request_.is_sent();
  std::array<pollfd, 2> polled{
      pollfd{.fd = link_.data.get(),
             .events = static_cast<short>(sending ? POLLIN | POLLOUT : POLLIN),
             .revents = 0},
      pollfd{.fd = link_.control.get(), .events = POLLIN, .revents = 0}};
  // A signal ends it early, then the tick is due a little later: no harm.
  ::poll(polled.data(), polled.size(), static_cast<int>(kTick.count()));
}

void Call::send_request()
{
  bool alive = true;
  if (!link_.settings_are_told) {
    alive = settings_request_.send_some(link_.data.get());
    link_.settings_are_told = settings_request_.is_sent();
  }
  if (alive && link_.settings_are_told) alive = request_.send_some(link_.data.get());
  if (!alive && !link_.has_joined()) link_.zygote_is_gone = true;
}

// Behind a large request that the model zygote is still reading there may be no room at once.
void Call::send_kill()
{
  if (!kill_sent_) kill_sent_ = send_signal(link_.data.get(), PacketKind::kill_job, number_);
}

void Call::receive_data()
{
  // A large result keeps coming for seconds; the caller and the limits have their turn in between.
  constexpr int kMaxPackets = 64;
  for (int i = 0; i < kMaxPackets && !outcome_; ++i) {
    const auto packet = link_.data_packets.receive(link_.data.get(), false);
    if (!packet) break;
    // Lower numbers: what a job still said when it was already given up.
    if (packet->header.call == number_) accept_data(*packet);
  }
  if (link_.has_joined() && link_.data_packets.is_closed() && !outcome_) finish_lost();
}

void Call::receive_control()
{
  while (const auto packet = link_.control_packets.receive(link_.control.get(), false))
    accept_control(*packet);
  link_.zygote_is_gone = link_.zygote_is_gone || link_.control_packets.is_closed();
  if (!link_.zygote_is_gone || outcome_) return;
  if (link_.has_joined()) link_.data.close();  // A job there ends.
  finish({.status = JobStatus::crashed,
          .code = SIGKILL,
          .loads_are_lost = true,
          .message = "the worker process of this rank is gone, killed from outside; "
                     "no more jobs can be run"});
}

void Call::accept_data(const Packet& packet)
{
  switch (packet.header.kind) {
    case PacketKind::usage:
      usage_ = packet.value<UsageReport>();
      break;
    case PacketKind::repairs:
      repairs_ = packet.value<RepairCounts>();
      break;
    case PacketKind::result:
    case PacketKind::failure:
      accept_answer(packet);
      break;
    case PacketKind::progress:
      if (watch_) watch_->note_progress();
      break;
    case PacketKind::job_started:
      job_ = packet.value<pid_t>();
      break;
    case PacketKind::job_ended:
      finish_ended(packet.value<ProcessEnd>(), false);
      break;
    default:
      break;
  }
}

void Call::accept_answer(const Packet& packet)
{
  answered_ = answer_.add(packet);
  // A job's answer counts only when the job has ended. A load's counts at once, unless the load is
  // to be killed: a load killed a moment too late is lost all the same.
  if (answered_ && kind_ != PacketKind::run && !kill_reason_) finish_answered();
}

void Call::accept_control(const Packet& packet)
{
  if (packet.header.kind == PacketKind::model_started) link_.model = packet.value<pid_t>();
  if (packet.header.kind != PacketKind::model_ended) return;
  link_.model_was_started = false;
  link_.model = 0;
  if (!outcome_) finish_ended(packet.value<ProcessEnd>(), true);
}

void Call::tick(Clock::time_point now)
{
  const double since_last_tick_s = seconds_between(std::exchange(last_tick_, now), now);
  if (kill_reason_) {
    if (now - kill_time_ < (link_.is_shared() ? kPatienceIfShared : kPatience)) return;
    kill(killed_ == Target::job ? Target::model : Target::zygote, now);
    return;
  }
  bool go_on = true;
  try {
    go_on = !on_wait_ || on_wait_();
  } catch (...) {
    thrown_ = std::current_exception();
    go_on = false;
  }
  kill_reason_ = go_on ? reason_to_kill(since_last_tick_s) : JobStatus::cancelled;
  if (kill_reason_ == JobStatus::cancelled && kind_ != PacketKind::run && link_.has_joined()) {
    finish_lost();  // The load goes on for others.
    return;
  }
  if (kill_reason_) kill(kind_ == PacketKind::run ? Target::job : Target::model, now);
}

std::optional<JobStatus> Call::reason_to_kill(double since_last_tick_s)
{
  const pid_t worker = job_ > 0 ? job_ : link_.model;
  const auto sample = worker > 0 ? sample_process(worker) : std::nullopt;
  if (!watch_ || worker != watched_) {
    // A job's time counts from its start, a load's from the first look at the model zygote.
    const double cpu_before_s = sample && job_ == 0 ? sample->cpu_s : 0.0;
    watch_.emplace(limits_, cpu_before_s);
    watched_ = worker;
  }
  return watch_->look(sample, since_last_tick_s);
}

void Call::kill(Target target, Clock::time_point now)
{
  killed_ = target;
  kill_time_ = now;
  kill_sent_ = target != Target::job;  // else by send_kill()
  if (target == Target::model) link_.kill_model();
  if (target != Target::zygote) return;
  // A child of this process, so the number is surely its own; the others follow it.
  if (link_.has_joined())
    finish_lost();
  else
    ::kill(link_.zygote, SIGKILL);
}

void Call::finish(JobEnd end)
{
  outcome_.emplace(JobOutcome{std::move(end)});
  if (watch_) {
    outcome_->cpu_s = watch_->cpu_s();
    outcome_->peak_rss_bytes = watch_->peak_rss_bytes();
  }
  if (usage_) {
    outcome_->cpu_s = usage_->cpu_s;
    outcome_->peak_rss_bytes = usage_->peak_rss_bytes;
    // The parts that were given back between the peak and the report were this process's own.
    const std::size_t returned =
        usage_->peak_rss_bytes - std::min(usage_->peak_rss_bytes, usage_->rss_bytes);
    link_.peak_bytes = std::max(link_.peak_bytes, usage_->together_bytes + returned);
  }
}

// The model zygote that this rank has joined is gone, or nothing is to be heard of it any more. Of
// how it ended only its own rank is told.
void Call::finish_lost()
{
  link_.data.close();
  if (kill_reason_) {
    finish({.status = *kill_reason_, .message = killed_message(*kill_reason_)});
  } else {
    finish({.status = JobStatus::crashed,
            .code = SIGKILL,
            .message = "the process that holds the model for this node is gone"});
  }
  outcome_->message += "; what had been loaded is lost";
  outcome_->loads_are_lost = true;
}

void Call::finish_ended(const ProcessEnd& end, bool is_model)
{
  if (kill_reason_) {
    finish({.status = *kill_reason_, .message = killed_message(*kill_reason_)});
  } else if (answered_ && !is_model) {
    finish_answered();
  } else if (end.fork_error != 0) {
    finish({.status = JobStatus::failed,
            .error = ErrorKind::other,
            .message = fmt::format("cannot start a process: {}", ::strerror(end.fork_error))});
  } else if (WIFSIGNALED(end.wait_status)) {
    const int signal = WTERMSIG(end.wait_status);
    finish({.status = JobStatus::crashed, .code = signal, .message = signal_message(signal)});
  } else {
    const int code = WEXITSTATUS(end.wait_status);
    finish({.status = JobStatus::exited,
            .code = code,
            .message = fmt::format("called exit({})", code)});
  }
  if (is_model) {
    if (kind_ == PacketKind::run)
      outcome_->message = "the process that holds the model: " + outcome_->message;
    outcome_->message += "; what had been loaded is lost";
    outcome_->loads_are_lost = true;
    link_.peak_bytes = std::max(link_.peak_bytes, static_cast<std::size_t>(end.peak_rss_bytes));
  } else {
    note_usage(end);
  }
}

// What the kernel counted is exact, and there also for processes that could report nothing.
void Call::note_usage(const ProcessEnd& end)
{
  outcome_->cpu_s = end.cpu_s;
  outcome_->peak_rss_bytes = end.peak_rss_bytes;
  const std::size_t own = end.peak_rss_bytes - std::min(end.peak_rss_bytes, link_.model_bytes);
  link_.peak_bytes = std::max(link_.peak_bytes, link_.loaded_bytes + own);
}

void Call::finish_answered()
{
  if (answer_.header().kind == PacketKind::result) {
    finish({});
    outcome_->result = answer_.take();
    note_repairs(repairs_);
  } else {
    finish(from_bytes<JobEnd>(answer_.take()));
  }
  if (kind_ == PacketKind::load && usage_) {
    link_.loaded_bytes = usage_->together_bytes;
    link_.model_bytes = usage_->rss_bytes;
  }
}

std::string Call::killed_message(JobStatus reason) const
{
  switch (reason) {
    case JobStatus::out_of_time:
      return fmt::format("used more than {:g} s of CPU time", limits_.cpu_s);
    case JobStatus::stalled:
      if (watch_ && watch_->is_idle())
        return fmt::format("made no progress in {:.0f} s of CPU time", watch_->cpu_without_s());
      return fmt::format("used no CPU time for {:g} s", limits_.stall_s);
    case JobStatus::out_of_memory:
      return fmt::format("used more than {:g} GiB of memory", limits_.memory_gib);
    default:
      return "cancelled";
  }
}

}  // namespace tessera::jobs
