// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/packet.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/socket.h>
#include <sys/uio.h>

namespace tessera::jobs {
namespace {

// Fits the default send buffer of a local socket (208 KiB) three times, so that sender and receiver
// overlap.
constexpr std::size_t kMaxPayload = std::size_t{64} * 1024;

enum class Sent { yes, would_wait, never };

Sent send_packet(int socket, const PacketHeader& header, std::span<const std::byte> payload,
                 bool wait)
{
  PacketHeader head = header;
  // sendmsg() takes pointers to non-const, but writes nothing.
  std::array<iovec, 2> parts{
      iovec{.iov_base = &head, .iov_len = sizeof(head)},
      iovec{.iov_base = const_cast<std::byte*>(payload.data()), .iov_len = payload.size()}};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  const int flags = MSG_NOSIGNAL | (wait ? 0 : MSG_DONTWAIT);
  while (::sendmsg(socket, &message, flags) < 0) {
    if (errno == EINTR) continue;
    const bool full = errno == EAGAIN || errno == EWOULDBLOCK;
    return full && !wait ? Sent::would_wait : Sent::never;
  }
  return Sent::yes;
}

}  // namespace

Outgoing::Outgoing(PacketKind kind, std::uint32_t call, std::span<const std::byte> bytes)
    : header_{.kind = kind, .call = call, .message_size = bytes.size()}, rest_(bytes)
{
}

bool Outgoing::send(int socket, bool wait)
{
  while (!sent_) {
    const auto payload = rest_.first(std::min(rest_.size(), kMaxPayload));
    const Sent sent = send_packet(socket, header_, payload, wait);
    if (sent != Sent::yes) return sent == Sent::would_wait;
    rest_ = rest_.subspan(payload.size());
    sent_ = rest_.empty();
  }
  return true;
}

bool send_signal(int socket, PacketKind kind, std::uint32_t call)
{
  return send_packet(socket, PacketHeader{.kind = kind, .call = call}, {}, false) == Sent::yes;
}

Incoming::Incoming() : buffer_(sizeof(PacketHeader) + kMaxPayload) {}

std::optional<Packet> Incoming::receive(int socket, bool wait)
{
  ssize_t size = 0;
  do {
    size = ::recv(socket, buffer_.data(), buffer_.size(), wait ? 0 : MSG_DONTWAIT);
  } while (size < 0 && errno == EINTR);

  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return std::nullopt;
  if (size < static_cast<ssize_t>(sizeof(PacketHeader))) {
    closed_ = true;
    return std::nullopt;
  }
  Packet packet;
  std::memcpy(&packet.header, buffer_.data(), sizeof(packet.header));
  packet.payload = std::span<const std::byte>(buffer_.data(), static_cast<std::size_t>(size))
                       .subspan(sizeof(packet.header));
  return packet;
}

bool Assembly::add(const Packet& packet)
{
  const bool continues =
      !complete_ && packet.header.kind == header_.kind && packet.header.call == header_.call;
  if (!continues) {
    header_ = packet.header;
    bytes_.clear();
    bytes_.reserve(static_cast<std::size_t>(header_.message_size));
  }
  bytes_.insert(bytes_.end(), packet.payload.begin(), packet.payload.end());
  complete_ = bytes_.size() >= header_.message_size;
  return complete_;
}

Bytes Assembly::take() { return std::exchange(bytes_, {}); }

}  // namespace tessera::jobs
