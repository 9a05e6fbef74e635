// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/zygote.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "jobs/child_process.hpp"
#include "jobs/model_zygote.hpp"
#include "jobs/packet.hpp"

namespace tessera::jobs {
namespace {

class Zygote {
 public:
  Zygote(ZygoteSockets sockets, const MakeWorker& make_worker)
      : sockets_(std::move(sockets)), make_worker_(make_worker)
  {
  }

  // Until the rank has closed its socket.
  void serve()
  {
    while (!requests_.is_closed()) {
      children_.wait({{.fd = sockets_.control.get(), .events = POLLIN, .revents = 0}});
      report_end_of_model();
      while (const auto packet = requests_.receive(sockets_.control.get(), false)) {
        if (packet->header.kind == PacketKind::start_model) start_model(packet->header.call);
        if (packet->header.kind == PacketKind::kill_model && model_ > 0) ::kill(model_, SIGKILL);
      }
    }
    if (model_ <= 0) return;
    ::kill(model_, SIGKILL);
    ::waitpid(model_, nullptr, 0);
    reap_orphans();
  }

 private:
  void start_model(std::uint32_t first_call)
  {
    const pid_t zygote = ::getpid();
    model_ = ::fork();
    if (model_ == 0) {
      die_with_parent(zygote);
      unblock_signals();
      const std::array keep{sockets_.data.get()};
      close_all_but(keep);
      run_model_zygote(zygote, std::move(sockets_.data), first_call, make_worker_);
    }
    if (model_ > 0)
      send_value(sockets_.control.get(), PacketKind::model_started, 0, model_);
    else
      send_value(sockets_.control.get(), PacketKind::model_ended, 0,
                 ProcessEnd{.fork_error = errno});
  }

  void report_end_of_model()
  {
    const std::optional<ProcessEnd> end = children_.reap(model_);
    if (!end) return;
    model_ = 0;
    reap_orphans();
    send_value(sockets_.control.get(), PacketKind::model_ended, 0, *end);
  }

  // A job whose model zygote died dies too and becomes a child of this process. It gets a second:
  // it may have children of its own that do not end.
  static void reap_orphans()
  {
    constexpr int kMaxLooks = 1000;
    for (int look = 0; look < kMaxLooks; ++look) {
      const pid_t reaped = ::waitpid(-1, nullptr, WNOHANG);
      if (reaped < 0) return;
      if (reaped == 0) ::usleep(1000);
    }
  }

  ZygoteSockets sockets_;
  const MakeWorker& make_worker_;
  ChildWatch children_{};
  Incoming requests_{};
  pid_t model_ = 0;
};

void detach_standard_streams()
{
  const FileDescriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  ::dup2(nothing.get(), STDIN_FILENO);
  redirect_output({});
}

}  // namespace

void run_zygote(pid_t rank_process, ZygoteSockets sockets, const MakeWorker& make_worker)
{
  die_with_parent(rank_process);
  ignore_group_signals();
  unblock_signals();
  const std::array keep{sockets.control.get(), sockets.data.get()};
  close_all_but(keep);
  detach_standard_streams();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  Zygote(std::move(sockets), make_worker).serve();
  ::_exit(0);
}

}  // namespace tessera::jobs
