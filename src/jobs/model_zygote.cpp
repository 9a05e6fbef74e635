// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/model_zygote.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <deque>
#include <iterator>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <poll.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/threads.hpp"
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

// What waits for room in the socket of a rank that does not read at the moment. Nobody else may
// have to wait for it.
struct Message {
  PacketKind kind = PacketKind::result;
  std::uint32_t call = 0;
  Bytes bytes{};
};

// A rank that has its jobs done here: the host, whose grandchild this process is, or a guest, which
// has joined.
struct Client {
  FileDescriptor socket{};
  std::optional<Cores> cores{};  ///< Of its jobs; nothing: where this process may run.
  std::uint32_t first_call = 0;  ///< Requests with lower numbers are out of date.
  Incoming packets{};
  Assembly request{};
  ClientSettings settings{};
  /// One for all jobs: to open it for each is a load on a parallel file system.
  FileDescriptor log{};
  std::deque<Message> unsent{};
  std::size_t num_loads = 0;
  std::uint32_t call = 0;  ///< That `job` works on.
  pid_t job = 0;           ///< 0 if none runs.
};

// What became of a load. Every rank that has joined asks for the same loads in the same order; each
// is done once, when the first one asks.
struct Load {
  Hash128 message{};
  std::optional<JobEnd> failure{};
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
    while (!host().packets.is_closed()) {
      wait();
      report_ended_jobs();
      admit();
      for (Client& client : clients_) {
        send_unsent(client);
        answer(client);
      }
      dismiss();
    }
  }

 private:
  Client& host() { return clients_.front(); }

  // Made with the first request, so that its failure is that request's outcome.
  Worker& worker()
  {
    if (!worker_) worker_ = make_worker_();
    return *worker_;
  }

  void wait() const
  {
    std::vector<pollfd> polled{{.fd = door_.get(), .events = POLLIN, .revents = 0}};
    for (const Client& client : clients_) {
      const int events = client.unsent.empty() ? POLLIN : POLLIN | POLLOUT;
      polled.push_back(
          {.fd = client.socket.get(), .events = static_cast<short>(events), .revents = 0});
    }
    children_->wait(std::move(polled));
  }

  static void post(Client& client, PacketKind kind, std::uint32_t call, Bytes bytes)
  {
    client.unsent.push_back({kind, call, std::move(bytes)});
    send_unsent(client);
  }

  // Each message is one packet, so none is sent in part.
  static void send_unsent(Client& client)
  {
    while (!client.unsent.empty()) {
      const Message& next = client.unsent.front();
      Outgoing message(next.kind, next.call, next.bytes);
      if (message.send_some(client.socket.get()) && !message.is_sent()) return;
      client.unsent.pop_front();
    }
  }

  void report_ended_jobs()
  {
    for (Client& client : clients_) {
      const auto end = children_->reap(client.job);
      if (!end) continue;
      client.job = 0;
      post(client, PacketKind::job_ended, client.call, to_bytes(*end));
    }
  }

  void admit()
  {
    if (door_.get() < 0) return;
    try {
      while (auto line = accept_on_node(door_)) {
        const auto cores = cores_of(line->peer);
        if (!cores || !make_room_on(*cores)) continue;
        Client& guest = clients_.emplace_back();
        guest.socket = std::move(line->socket);
        guest.cores = cores;
        post(guest, PacketKind::model_started, 0, to_bytes(::getpid()));
      }
    } catch (const Error&) {  // Who comes later is refused, and says so.
      door_.close();
    }
  }

  // Lets this process run on the cores of a guest too: on those of the host alone every fork would
  // wait for the host's job. Whether a guest's job may run there is tried first.
  bool make_room_on(const Cores& cores)
  {
    const auto own = cores_of(0);
    if (!own) return false;
    if (!host().cores) host().cores = own;
    const bool is_allowed = move_to(cores);
    move_to(is_allowed ? *own | cores : *own);
    return is_allowed;
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

  // Jobs of guests that are gone end with them. A guest is forgotten when its job has ended.
  void dismiss()
  {
    for (auto guest = std::next(clients_.begin()); guest != clients_.end();) {
      const bool is_gone = guest->packets.is_closed();
      if (is_gone) guest->socket.close();
      if (is_gone && guest->job > 0) ::kill(guest->job, SIGKILL);
      guest = is_gone && guest->job == 0 ? clients_.erase(guest) : std::next(guest);
    }
  }

  void obey(Client& client, const PacketHeader& header, const Bytes& message)
  {
    switch (header.kind) {
      case PacketKind::settings:
        client.settings = from_bytes<ClientSettings>(message);
        client.log = open_log(client.settings.log_file);
        break;
      case PacketKind::prepare:
        prepare();
        break;
      case PacketKind::open_door:
        open_door(client, header.call, message);
        break;
      case PacketKind::load:
        load(client, header.call, message);
        break;
      default:
        run(client, header, message);
    }
  }

  static void kill_job(Client& client, std::uint32_t call)
  {
    if (client.job > 0 && client.call == call)
      ::kill(client.job, SIGKILL);
    else  // before all of its request was here
      post(client, PacketKind::job_ended, call, to_bytes(ProcessEnd{}));
  }

  void prepare()
  {
    try {
      worker();
    } catch (...) {  // The first request says why.
    }
  }

  void open_door(Client& client, std::uint32_t call, const Bytes& name)
  {
    try {
      door_.close();
      if (!name.empty()) door_ = listen_on_node(text_of(name));
      post(client, PacketKind::result, call, {});
    } catch (...) {
      post(client, PacketKind::failure, call, to_bytes(current_failure()));
    }
  }

  void load(Client& client, std::uint32_t call, const Bytes& message)
  {
    const double cpu_before_s = cpu_time_of_this_process();
    const std::size_t number = client.num_loads++;
    const Hash128 hash = hash_bytes(message);
    if (number == loads_.size()) loads_.push_back({hash, load_into_worker(client, message)});
    report_usage_of_load(client, call, cpu_before_s);
    const Load& done = loads_[number];
    if (done.message != hash) {
      const JobEnd failure{.status = JobStatus::failed,
                           .error = ErrorKind::other,
                           .message = "ranks of one node load different things"};
      post(client, PacketKind::failure, call, to_bytes(failure));
    } else if (done.failure) {
      post(client, PacketKind::failure, call, to_bytes(*done.failure));
    } else {
      post(client, PacketKind::result, call, {});
    }
  }

  // The memory of the zygotes is the host's.
  void report_usage_of_load(Client& client, std::uint32_t call, double cpu_before_s)
  {
    const bool is_host = &client == &host();
    UsageReport usage = usage_of_this_process(cpu_before_s, is_host ? zygotes_bytes_ : 0);
    if (!is_host) usage.peak_rss_bytes = usage.rss_bytes;
    post(client, PacketKind::usage, call, to_bytes(usage));
  }

  std::optional<JobEnd> load_into_worker(const Client& client, const Bytes& message)
  {
    std::optional<JobEnd> failure;
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

  void run(Client& client, const PacketHeader& header, const Bytes& request)
  {
    const std::uint32_t call = header.call;
    try {
      worker();
    } catch (...) {
      post(client, PacketKind::failure, call, to_bytes(current_failure()));
      post(client, PacketKind::job_ended, call, to_bytes(ProcessEnd{}));
      return;
    }
    if (zygotes_bytes_ == 0) measure_zygotes();
    const pid_t model_zygote = ::getpid();
    const pid_t job = ::fork();
    if (job == 0) {
      die_with_parent(model_zygote);
      if (client.cores) move_to(*client.cores);
      if (header.kind == PacketKind::run_alone) spread_over_node(client.settings);
      run_in_this_process(client, call, request);
    }
    if (job < 0) {
      post(client, PacketKind::job_ended, call, to_bytes(ProcessEnd{.fork_error = errno}));
      return;
    }
    client.call = call;
    client.job = job;
    post(client, PacketKind::job_started, call, to_bytes(job));
  }

  // A thread for each rank of the node, on the cores of all of them: on those that the system lets
  // this process have.
  static void spread_over_node(const ClientSettings& settings)
  {
    Cores all;
    for (const int core : settings.cores_of_node) all.set(at(core));
    if (!move_to(all)) return;
    const auto num_cores = cores_of(0).value_or(Cores{}).count();
    set_num_threads(std::min(settings.num_ranks_of_node, static_cast<int>(num_cores)));
  }

  [[noreturn]] void run_in_this_process(const Client& client, std::uint32_t call,
                                        const Bytes& request)
  {
    unblock_signals();
    children_ = {};
    redirect_output(client.log);
    begin_progress_reports(client.socket.get(), call);
    try {
      static_cast<void>(take_noted_repairs());  // Of loads.
      const Bytes result = worker().run(request);
      report_usage_of_job(client, call);
      send_value(client.socket.get(), PacketKind::repairs, call, take_noted_repairs());
      Outgoing(PacketKind::result, call, result).send_all(client.socket.get());
    } catch (...) {
      const JobEnd failure = current_failure();
      report_usage_of_job(client, call);
      send_value(client.socket.get(), PacketKind::failure, call, failure);
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
    const std::size_t zygotes = &client == &host() ? zygotes_bytes_ : 0;
    send_value(client.socket.get(), PacketKind::usage, call,
               usage_of_this_process(0.0, zygotes + private_rss_bytes()));
  }

  pid_t zygote_;
  const MakeWorker& make_worker_;
  std::optional<ChildWatch> children_{std::in_place};
  std::list<Client> clients_{};  ///< The host first.
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
