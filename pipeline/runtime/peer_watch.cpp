// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/peer_watch.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fmt/format.h>
#include <linux/tcp.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tessera/base/held_signals.hpp"

#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {
namespace {

using std::chrono::milliseconds;

// States of a connection as the kernel counts; <netinet/tcp.h>, which names them, clashes with
// <linux/tcp.h>, which alone has all of tcp_info.
constexpr int kEstablished = 1;
constexpr int kConnecting = 2;

// Looks in which a peer does not answer before it is lost: an answer may be on its way in one of
// them. So many looks old a connection is before its end means something: MPI drops one of two that
// peers open to each other at the same time.
constexpr int kLooks = 4;

struct Connection {
  std::string peer = "a peer";  // Its address, when it has answered once.
  int num_looks = 0;
  int num_looks_in_vain = 0;  // The last ones, all without an answer.
  bool is_there = true;
};

// Sockets by their number in the kernel: descriptors are given again.
using Connections = std::map<ino_t, Connection>;

// Not its name: a name server may be out of reach too.
std::string peer_of(int descriptor)
{
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> text{};
  if (::getpeername(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0
      || ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, text.data(), text.size(),
                       nullptr, 0, NI_NUMERICHOST)
             != 0) {
    return "a peer";
  }
  return text.data();
}

// Nothing if the descriptor is no TCP connection that is there or is being made.
std::optional<tcp_info> connection_at(int descriptor)
{
  int domain = 0;
  socklen_t size = sizeof domain;
  if (::getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &domain, &size) != 0) return std::nullopt;
  if (domain != AF_INET && domain != AF_INET6) return std::nullopt;
  tcp_info info{};
  size = sizeof info;
  if (::getsockopt(descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  if (info.tcpi_state != kEstablished && info.tcpi_state != kConnecting) return std::nullopt;
  return info;
}

// The kernel asks a peer that has been silent for a third of the limit, and goes on asking: what
// follows is decided here, and not by an error that MPI would see.
void ask_when_silent(int descriptor, milliseconds silence)
{
  const auto set = [&](int level, int option, int value) {
    ::setsockopt(descriptor, level, option, &value, sizeof value);
  };
  const auto seconds = [](milliseconds time) {
    return std::max(1, static_cast<int>(time.count() / 1000));
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, seconds(silence / 3));
  set(IPPROTO_TCP, TCP_KEEPINTVL, seconds(silence / 6));
  set(IPPROTO_TCP, TCP_KEEPCNT, 127);
}

// Asked, and not answered yet.
bool is_asked(const tcp_info& info)
{
  return info.tcpi_state == kConnecting || info.tcpi_retransmits + info.tcpi_probes > 0;
}

bool is_lost(const Connection& connection, const tcp_info& info, const PeerLimits& limits)
{
  if (info.tcpi_state == kConnecting)
    return connection.num_looks_in_vain >= limits.silence / limits.look;
  return connection.num_looks_in_vain >= kLooks
         && milliseconds(info.tcpi_last_ack_recv) >= limits.silence;
}

// Why the peer at a descriptor is lost; nothing if it is not, or there is none.
std::optional<std::string> look_at(int descriptor, Connections& connections,
                                   const PeerLimits& limits)
{
  struct stat entry {};
  const auto info = connection_at(descriptor);
  if (!info || ::fstat(descriptor, &entry) != 0) return std::nullopt;
  const auto [place, is_new] = connections.try_emplace(entry.st_ino);
  Connection& connection = place->second;
  if (is_new) ask_when_silent(descriptor, limits.silence);
  if (info->tcpi_state == kEstablished) connection.peer = peer_of(descriptor);
  connection.is_there = true;
  // Before the peer has said something, only its kernel has taken the connection: where both sides
  // have made one, MPI closes the other one.
  if (info->tcpi_bytes_received > 0) ++connection.num_looks;
  connection.num_looks_in_vain = is_asked(*info) ? connection.num_looks_in_vain + 1 : 0;
  if (!is_lost(connection, *info, limits)) return std::nullopt;
  return fmt::format("no answer from {} for {} s; its node or the network to it is down",
                     connection.peer, limits.silence.count() / 1000);
}

// Connections that have been closed: a peer ends before this process only if something went wrong.
std::optional<std::string> gone_peer(Connections& connections)
{
  std::optional<std::string> lost;
  for (auto it = connections.begin(); it != connections.end();) {
    Connection& connection = it->second;
    if (std::exchange(connection.is_there, false)) {
      ++it;
      continue;
    }
    if (connection.num_looks >= kLooks) {
      lost = fmt::format("the connection to {} has been closed; a process there has ended",
                         connection.peer);
    }
    it = connections.erase(it);
  }
  return lost;
}

std::optional<std::string> look_at_all(Connections& connections, const PeerLimits& limits)
{
  DIR* const folder = ::opendir("/proc/self/fd");
  if (folder == nullptr) return std::nullopt;
  std::optional<std::string> lost;
  while (const dirent* const entry = ::readdir(folder)) {
    const int descriptor = std::atoi(entry->d_name);
    if (descriptor <= STDERR_FILENO) continue;  // The caller's, or "." and "..".
    const auto found = look_at(descriptor, connections, limits);
    if (!lost) lost = found;
  }
  ::closedir(folder);
  const auto gone = gone_peer(connections);
  return lost ? lost : gone;
}

}  // namespace

PeerWatch::PeerWatch(std::function<void(const std::string&)> on_lost, PeerLimits limits)
    : on_lost_(std::move(on_lost))
{
  const HeldSignals held{SIGINT, SIGTERM, SIGUSR1};  // They are for the main thread.
  try {
    thread_ = std::thread([this, limits] { run(limits); });
  } catch (const std::system_error& error) {  // No more threads for this user.
    std::fprintf(stderr, "tessera: warning: nobody watches for lost ranks: %s\n", error.what());
  }
}

PeerWatch::~PeerWatch()
{
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void PeerWatch::run(const PeerLimits& limits)
{
  Connections connections;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, limits.look, [&] { return is_over_; })) {
    const auto lost = look_at_all(connections, limits);
    if (!lost) continue;
    on_lost_(*lost);
    return;
  }
}

void end_without_peer(const std::string& sentence)
{
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::fprintf(stderr, "tessera: %s; seen from %s; a mesh goes on with --resume\n",
               sentence.c_str(), host.data());
  ::_exit(static_cast<int>(ExitCode::stopped));
}

}  // namespace tessera::pipeline
