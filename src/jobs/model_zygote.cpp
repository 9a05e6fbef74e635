// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/model_zygote.hpp"

#include <cerrno>
#include <csignal>
#include <iterator>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/hash.hpp"
#include "tessera/jobs/this_process.hpp"

#include "jobs/child_process.hpp"
#include "jobs/failure.hpp"
#include "jobs/job_progress.hpp"
#include "jobs/node_socket.hpp"
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

std::string text_of(const Bytes& bytes)
{
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A rank that has its jobs done here: the one whose grandchild this process is, or one of its node
// that has joined.
struct Client {
  FileDescriptor socket{};
  pid_t joined_from = 0;         ///< The process of a rank that has joined.
  std::uint32_t first_call = 0;  ///< Requests with lower numbers are out of date.
  Incoming packets{};
  Assembly request{};
  FileDescriptor
      log{};  ///< One for all jobs: to open it for each is a load on a parallel file system.
  std::size_t num_loads = 0;
  std::uint32_t call = 0;  ///< That `job` works on.
  pid_t job = 0;           ///< 0 if none runs.
};

// What became of a load. Every rank that has joined asks for the same loads in the same order; each
// is done once, when the first one asks.
struct Load {
  Hash128 message{};
  std::optional<Failure> failure{};
};

class ModelZygote {
 public:
  ModelZygote(pid_t zygote, FileDescriptor data, std::uint32_t first_call,
              const MakeWorker& make_worker)
      : zygote_(zygote), make_worker_(make_worker)
  {
    clients_.push_back({.socket = std::move(data), .first_call = first_call});
  }

  // Until the rank has closed its socket.
  void serve()
  {
    while (!owner().packets.is_closed()) {
      wait();
      report_ended_jobs();
      admit();
      for (Client& client : clients_) answer(client);
      dismiss();
    }
  }

 private:
  Client& owner() { return clients_.front(); }

  // Made with the first request, so that its failure is that request's outcome.
  Worker& worker()
  {
    if (!worker_) worker_ = make_worker_();
    return *worker_;
  }

  void wait() const
  {
    std::vector<int> sockets;
    for (const Client& client : clients_) sockets.push_back(client.socket.get());
    if (door_.get() >= 0) sockets.push_back(door_.get());
    children_->wait(sockets);
  }

  void report_ended_jobs()
  {
    for (Client& client : clients_) {
      const auto end = children_->reap(client.job);
      if (!end) continue;
      client.job = 0;
      send_value(client.socket.get(), PacketKind::job_ended, client.call, *end);
    }
  }

  void admit()
  {
    while (door_.get() >= 0) {
      auto line = accept_on_node(door_);
      if (!line) return;
      send_value(line->socket.get(), PacketKind::model_started, 0, ::getpid());
      clients_.push_back({.socket = std::move(line->socket), .joined_from = line->peer});
    }
  }

  void answer(Client& client)
  {
    while (const auto packet = client.packets.receive(client.socket.get(), false)) {
      const PacketHeader header = packet->header;
      if (header.call < client.first_call) continue;
      if (header.kind == PacketKind::kill_job)
        kill_job(client, header.call);
      else if (client.request.add(*packet))
        obey(client, header, client.request.take());
    }
  }

  // Jobs of ranks that are gone end with them.
  void dismiss()
  {
    for (auto client = std::next(clients_.begin()); client != clients_.end();) {
      if (!client->packets.is_closed()) {
        ++client;
        continue;
      }
      if (client->job > 0) {
        ::kill(client->job, SIGKILL);
        ::waitpid(client->job, nullptr, 0);
      }
      client = clients_.erase(client);
    }
  }

  void obey(Client& client, const PacketHeader& header, const Bytes& message)
  {
    switch (header.kind) {
      case PacketKind::log_file:
        client.log = open_log(text_of(message));
        break;
      case PacketKind::open_door:
        open_door(header.call, message);
        break;
      case PacketKind::load:
        load(client, header.call, message);
        break;
      default:
        run(client, header.call, message);
    }
  }

  static void kill_job(const Client& client, std::uint32_t call)
  {
    if (client.job > 0 && client.call == call)
      ::kill(client.job, SIGKILL);
    else  // before all of its request was here
      send_value(client.socket.get(), PacketKind::job_ended, call, ProcessEnd{});
  }

  void open_door(std::uint32_t call, const Bytes& name)
  {
    door_.close();
    if (!name.empty()) {
      loads_.clear();
      owner().num_loads = 0;
      try {
        door_ =
            listen_on_node(std::string(reinterpret_cast<const char*>(name.data()), name.size()));
      } catch (...) {
        send_failure(owner(), call, current_failure());
        return;
      }
    }
    send_result(owner(), call, {});
  }

  void load(Client& client, std::uint32_t call, const Bytes& message)
  {
    const double cpu_before_s = cpu_time_of_this_process();
    const std::size_t number = client.num_loads++;
    const Hash128 hash = hash_bytes(message);
    if (number == loads_.size()) loads_.push_back({hash, load_into_worker(client, message)});
    const std::size_t together = &client == &owner() ? zygotes_bytes_ : 0;
    send_value(client.socket.get(), PacketKind::usage, call,
               usage_of_this_process(cpu_before_s, together));
    const Load& done = loads_[number];
    if (done.message != hash)
      send_failure(client, call, {.message = "ranks of one node load different things"});
    else if (done.failure)
      send_failure(client, call, *done.failure);
    else
      send_result(client, call, {});
  }

  std::optional<Failure> load_into_worker(const Client& client, const Bytes& message)
  {
    std::optional<Failure> failure;
    redirect_output(client.log);
    try {
      worker().load(message);
    } catch (...) {
      failure = current_failure();
    }
    flush_streams();
    redirect_output({});
    measure_zygotes();
    return failure;
  }

  void run(Client& client, std::uint32_t call, const Bytes& request)
  {
    try {
      worker();
    } catch (...) {
      send_failure(client, call, current_failure());
      send_value(client.socket.get(), PacketKind::job_ended, call, ProcessEnd{});
      return;
    }
    if (zygotes_bytes_ == 0) measure_zygotes();
    const pid_t model_zygote = ::getpid();
    const pid_t job = ::fork();
    if (job == 0) {
      die_with_parent(model_zygote);
      run_in_this_process(client, call, request);
    }
    if (job < 0) {
      send_value(client.socket.get(), PacketKind::job_ended, call, ProcessEnd{.fork_error = errno});
      return;
    }
    client.call = call;
    client.job = job;
    send_value(client.socket.get(), PacketKind::job_started, call, job);
  }

  [[noreturn]] void run_in_this_process(const Client& client, std::uint32_t call,
                                        const Bytes& request)
  {
    unblock_signals();
    children_ = {};
    if (client.joined_from > 0) run_where(client.joined_from);
    redirect_output(client.log);
    begin_progress_reports(client.socket.get(), call);
    try {
      const Bytes result = worker().run(request);
      report_usage_of_job(client, call);
      send_result(client, call, result);
    } catch (...) {
      const Failure failure = current_failure();
      report_usage_of_job(client, call);
      send_failure(client, call, failure);
    }
    flush_streams();
    // Destructors and exit handlers belong to the processes that this one is a copy of.
    ::_exit(0);
  }

  void measure_zygotes()
  {
    zygotes_bytes_ = proportional_rss_bytes(zygote_) + proportional_rss_bytes(::getpid());
  }

  // The zygotes write nothing while jobs run. A page that a job writes to becomes its own, and the
  // model zygote keeps the old one.
  void report_usage_of_job(const Client& client, std::uint32_t call)
  {
    const std::size_t zygotes = &client == &owner() ? zygotes_bytes_ : 0;
    send_value(client.socket.get(), PacketKind::usage, call,
               usage_of_this_process(0.0, zygotes + private_rss_bytes()));
  }

  static void send_result(const Client& client, std::uint32_t call, const Bytes& bytes)
  {
    Outgoing(PacketKind::result, call, bytes).send_all(client.socket.get());
  }

  static void send_failure(const Client& client, std::uint32_t call, const Failure& failure)
  {
    Outgoing(PacketKind::failure, call, to_bytes(failure)).send_all(client.socket.get());
  }

  pid_t zygote_;
  const MakeWorker& make_worker_;
  std::optional<ChildWatch> children_{std::in_place};
  std::list<Client> clients_{};  ///< The first one is the rank whose grandchild this process is.
  FileDescriptor door_{};        ///< Where ranks of the node may join.
  std::vector<Load> loads_{};
  std::unique_ptr<Worker> worker_{};
  std::size_t zygotes_bytes_ = 0;
};

}  // namespace

void run_model_zygote(pid_t zygote, FileDescriptor data, std::uint32_t first_call,
                      const MakeWorker& make_worker)
{
  ModelZygote(zygote, std::move(data), first_call, make_worker).serve();
  ::_exit(0);
}

}  // namespace tessera::jobs
