// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/model_zygote.hpp"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <unistd.h>

#include "tessera/jobs/this_process.hpp"

#include "jobs/child_process.hpp"
#include "jobs/failure.hpp"
#include "jobs/job_progress.hpp"
#include "jobs/packet.hpp"
#include "jobs/process_usage.hpp"

namespace tessera::jobs {
namespace {

UsageReport usage_of_this_process(double cpu_before_s, std::size_t together_bytes)
{
  const auto sample = sample_process(::getpid());
  return {.cpu_s = cpu_time_of_this_process() - cpu_before_s,
          .rss_bytes = sample ? sample->rss_bytes : 0,
          .peak_rss_bytes = peak_rss_bytes(::getpid()),
          .together_bytes = together_bytes};
}

class ModelZygote {
 public:
  ModelZygote(pid_t zygote, FileDescriptor data, const MakeWorker& make_worker)
      : zygote_(zygote), data_(std::move(data)), make_worker_(make_worker)
  {
  }

  // Until the rank has closed its socket.
  void serve(std::uint32_t first_call)
  {
    while (const auto packet = requests_.receive(data_.get(), true)) {
      const PacketHeader header = packet->header;
      if (header.call < first_call) continue;
      if (header.kind == PacketKind::kill_job) {  // before all of its request was here
        send_value(data_.get(), PacketKind::job_ended, header.call, ProcessEnd{});
        continue;
      }
      if (!request_.add(*packet)) continue;
      const Bytes message = request_.take();
      if (header.kind == PacketKind::log_file)
        log_ = open_log(std::string(reinterpret_cast<const char*>(message.data()), message.size()));
      else if (header.kind == PacketKind::load)
        load(header.call, message);
      else
        run(header.call, message);
    }
  }

 private:
  // Made with the first request, so that its failure is that request's outcome.
  Worker& worker()
  {
    if (!worker_) worker_ = make_worker_();
    return *worker_;
  }

  void load(std::uint32_t call, const Bytes& message)
  {
    const double cpu_before_s = cpu_time_of_this_process();
    redirect_output(log_);
    Failure failure;
    bool loaded = false;
    try {
      worker().load(message);
      loaded = true;
    } catch (...) {
      failure = current_failure();
    }
    flush_streams();
    redirect_output({});

    measure_zygotes();
    send_value(data_.get(), PacketKind::usage, call,
               usage_of_this_process(cpu_before_s, zygotes_bytes_));
    if (loaded)
      send_result(call, {});
    else
      send_failure(call, failure);
  }

  void run(std::uint32_t call, const Bytes& request)
  {
    try {
      worker();
    } catch (...) {
      send_failure(call, current_failure());
      send_value(data_.get(), PacketKind::job_ended, call, ProcessEnd{});
      return;
    }
    if (zygotes_bytes_ == 0) measure_zygotes();
    const pid_t model_zygote = ::getpid();
    const pid_t job = ::fork();
    if (job == 0) {
      die_with_parent(model_zygote);
      run_in_this_process(call, request);
    }
    if (job < 0) {
      send_value(data_.get(), PacketKind::job_ended, call, ProcessEnd{.fork_error = errno});
      return;
    }
    send_value(data_.get(), PacketKind::job_started, call, job);
    const ProcessEnd end = wait_for(job, call);
    send_value(data_.get(), PacketKind::job_ended, call, end);
  }

  [[noreturn]] void run_in_this_process(std::uint32_t call, const Bytes& request)
  {
    unblock_signals();
    children_ = {};
    redirect_output(log_);
    begin_progress_reports(data_.get(), call);
    try {
      const Bytes result = worker().run(request);
      report_usage_of_job(call);
      send_result(call, result);
    } catch (...) {
      const Failure failure = current_failure();
      report_usage_of_job(call);
      send_failure(call, failure);
    }
    flush_streams();
    // Destructors and exit handlers belong to the processes that this one is a copy of.
    ::_exit(0);
  }

  void measure_zygotes()
  {
    zygotes_bytes_ = proportional_rss_bytes(zygote_) + proportional_rss_bytes(::getpid());
  }

  // The zygotes sleep while a job runs. A page that a job writes to becomes its own, and the model
  // zygote keeps the old one.
  void report_usage_of_job(std::uint32_t call) const
  {
    send_value(data_.get(), PacketKind::usage, call,
               usage_of_this_process(0.0, zygotes_bytes_ + private_rss_bytes()));
  }

  ProcessEnd wait_for(pid_t job, std::uint32_t call)
  {
    while (true) {
      if (const auto end = children_->reap(job)) return *end;
      children_->wait(data_.get());
      while (const auto packet = requests_.receive(data_.get(), false))
        if (packet->header.kind == PacketKind::kill_job && packet->header.call == call)
          ::kill(job, SIGKILL);
      if (requests_.is_closed()) ::_exit(0);
    }
  }

  void send_result(std::uint32_t call, const Bytes& bytes) const
  {
    Outgoing(PacketKind::result, call, bytes).send_all(data_.get());
  }

  void send_failure(std::uint32_t call, const Failure& failure) const
  {
    Outgoing(PacketKind::failure, call, to_bytes(failure)).send_all(data_.get());
  }

  pid_t zygote_;
  FileDescriptor data_;
  const MakeWorker& make_worker_;
  std::optional<ChildWatch> children_{std::in_place};
  Incoming requests_{};
  Assembly request_{};
  FileDescriptor
      log_{};  // One for all jobs: to open it for each is a load on a parallel file system.
  std::unique_ptr<Worker> worker_{};
  std::size_t zygotes_bytes_ = 0;
};

}  // namespace

void run_model_zygote(pid_t zygote, FileDescriptor data, std::uint32_t first_call,
                      const MakeWorker& make_worker)
{
  ModelZygote(zygote, std::move(data), make_worker).serve(first_call);
  ::_exit(0);
}

}  // namespace tessera::jobs
