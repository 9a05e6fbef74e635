// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/node_socket.hpp"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

namespace tessera::jobs {
namespace {

struct Address {
  sockaddr_un name{};
  socklen_t size = 0;

  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&name); }
};

// A leading zero byte keeps the name out of the file system.
Address address_of(const std::string& name)
{
  Address address;
  if (name.size() >= sizeof(address.name.sun_path)) throw Error("the name of a socket is too long");
  address.name.sun_family = AF_UNIX;
  std::memcpy(address.name.sun_path + 1, name.data(), name.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

[[noreturn]] void throw_system_error(const char* what)
{
  throw Error(fmt::format("{}: {}", what, std::strerror(errno)));
}

FileDescriptor make_socket()
{
  FileDescriptor made(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (made.get() < 0) throw_system_error("socket");
  return made;
}

// The process at the other end, if it is of this user.
std::optional<pid_t> own_peer(const FileDescriptor& socket)
{
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool is_known = ::getsockopt(socket.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  if (!is_known || peer.uid != ::geteuid() || peer.pid <= 0) return std::nullopt;
  return peer.pid;
}

}  // namespace

std::string make_node_name()
{
  std::random_device random;
  return fmt::format("tessera-{}-{:08x}{:08x}", ::getpid(), random(), random());
}

FileDescriptor listen_on_node(const std::string& name)
{
  constexpr int kMostRanksOfNode = 4096;  // The kernel takes its own bound if that is lower.
  FileDescriptor listener = make_socket();
  const Address address = address_of(name);
  if (::bind(listener.get(), address.get(), address.size) != 0) throw_system_error("bind");
  if (::listen(listener.get(), kMostRanksOfNode) != 0) throw_system_error("listen");
  return listener;
}

std::optional<NodeLine> accept_on_node(const FileDescriptor& listener)
{
  while (true) {
    FileDescriptor socket(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (socket.get() < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return std::nullopt;
    if (socket.get() < 0 && errno != EINTR && errno != ECONNABORTED) throw_system_error("accept");
    if (socket.get() < 0) continue;
    if (const auto peer = own_peer(socket)) return NodeLine{std::move(socket), *peer};
  }
}

NodeLine connect_on_node(const std::string& name)
{
  FileDescriptor socket = make_socket();
  const Address address = address_of(name);
  // More ranks may come at once than the kernel lets wait.
  constexpr int kMaxTries = 1000;
  for (int tries = 1; ::connect(socket.get(), address.get(), address.size) != 0; ++tries) {
    const bool is_crowded = errno == EAGAIN || errno == EINTR;
    if (!is_crowded || tries == kMaxTries) throw_system_error("connect");
    ::usleep(10'000);
  }
  const auto peer = own_peer(socket);
  if (!peer) throw Error("connect: the process is of another user or container");
  return {std::move(socket), *peer};
}

}  // namespace tessera::jobs
