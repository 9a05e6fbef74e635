// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/zygote_link.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "jobs/node_socket.hpp"

namespace tessera::jobs {
namespace {

// What is waited for here takes milliseconds on an idle machine.
constexpr int kPatienceMs = 10'000;

std::optional<Packet> next_packet(Incoming& packets, const FileDescriptor& socket)
{
  pollfd polled{.fd = socket.get(), .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = ::poll(&polled, 1, kPatienceMs);
  } while (ready < 0 && errno == EINTR);
  return ready > 0 ? packets.receive(socket.get(), false) : std::nullopt;
}

// By such a handle a process can be killed of which this one is not the parent: its number could
// have gone to another one.
FileDescriptor handle_of(pid_t process)
{
  FileDescriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  if (handle.get() < 0) throw Error(fmt::format("pidfd_open: {}", std::strerror(errno)));
  return handle;
}

}  // namespace

void ZygoteLink::end_model()
{
  if (model_was_started) kill_model();
  while (model_was_started) {
    const auto packet = next_packet(control_packets, control);
    zygote_is_gone = !packet;
    if (zygote_is_gone) throw Error("the worker process of this rank does not answer");
    if (packet->header.kind == PacketKind::model_ended) model_was_started = false;
  }
}

void ZygoteLink::join(const std::string& name)
{
  NodeLine line = connect_on_node(name);
  Incoming packets;
  const auto hello = next_packet(packets, line.socket);
  if (!hello || hello->header.kind != PacketKind::model_started)
    throw Error("the worker process of the node does not answer, or cannot run on these cores");
  if (hello->value<pid_t>() != line.peer)
    throw Error("the worker process of the node has another number in this container");
  FileDescriptor handle = handle_of(line.peer);
  // Still there, so the handle is its own.
  if (packets.receive(line.socket.get(), false) || packets.is_closed())
    throw Error("the worker process of the node is gone");
  end_model();

  joined_model = std::move(handle);
  own_data = std::exchange(data, std::move(line.socket));
  data_packets = std::move(packets);
  model_was_started = true;
  model = line.peer;
  settings_are_told = false;
  loaded_bytes = 0;
  model_bytes = 0;
}

void ZygoteLink::leave()
{
  if (!has_joined()) return;
  joined_model.close();
  data = std::exchange(own_data, FileDescriptor());
  data_packets = {};
  model_was_started = false;
}

void ZygoteLink::kill_model()
{
  if (has_joined())
    ::syscall(SYS_pidfd_send_signal, joined_model.get(), SIGKILL, nullptr, 0);
  else
    send_signal(control.get(), PacketKind::kill_model, num_calls);
}

}  // namespace tessera::jobs
