// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tessera/base/bytes.hpp"

/// What the processes say to each other, over SOCK_SEQPACKET sockets. A packet arrives whole or not
/// at all. So a process that dies in the middle of a message leaves nothing that confuses the next.
namespace tessera::jobs {

enum class PacketKind : std::uint32_t {
  start_model,    ///< rank → zygote
  kill_model,     ///< rank → zygote
  model_started,  ///< zygote, or model zygote that a rank has joined → rank: pid_t
  model_ended,    ///< zygote → rank: ProcessEnd
  settings,       ///< rank → model zygote: ClientSettings
  prepare,        ///< rank → model zygote: make the worker already
  open_door,      ///< rank → its model zygote: where others may join, or empty: no more
  load,           ///< rank → model zygote: what Worker::load() gets
  run,            ///< rank → model zygote: what Worker::run() gets
  run_alone,      ///< the same, for a job that may have the cores of all ranks
  kill_job,       ///< rank → model zygote
  job_started,    ///< model zygote → rank: pid_t
  job_ended,      ///< model zygote → rank: ProcessEnd
  progress,       ///< job → rank
  usage,          ///< model zygote after a load, or job → rank: UsageReport
  repairs,        ///< job → rank: RepairCounts
  result,         ///< model zygote after a load or open_door, or job → rank: bytes
  failure,        ///< model zygote after a load or open_door, or job → rank: bytes of a JobEnd
};

/// @brief What holds for all later loads and jobs of a rank.
struct ClientSettings {
  std::string log_file{};  ///< Of what they print; empty: nowhere.
  int num_ranks_of_node = 1;
  std::vector<int> cores_of_node{};  ///< Numbers of those of all its ranks.

  static auto fields(auto& self)
  {
    return std::tie(self.log_file, self.num_ranks_of_node, self.cores_of_node);
  }
};

/// @brief How a process ended.
struct ProcessEnd {
  int wait_status = 0;  ///< As waitpid() tells it.
  int fork_error = 0;   ///< errno if the process could not even be started.
  double cpu_s = 0.0;
  std::uint64_t peak_rss_bytes = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.wait_status, self.fork_error, self.cpu_s, self.peak_rss_bytes);
  }
};

/// @brief What a process says about itself at the end of its work.
struct UsageReport {
  double cpu_s = 0.0;
  std::uint64_t rss_bytes = 0;
  std::uint64_t peak_rss_bytes = 0;
  /// It and the zygotes, shared pages once; 0 if not measured. Zygotes count for the rank alone
  /// whose children they are.
  std::uint64_t together_bytes = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.cpu_s, self.rss_bytes, self.peak_rss_bytes, self.together_bytes);
  }
};

struct PacketHeader {
  PacketKind kind = PacketKind::result;
  std::uint32_t call = 0;          ///< Number of the load or run that it is about.
  std::uint64_t message_size = 0;  ///< Of all packets of the message together, without headers.
};
static_assert(std::has_unique_object_representations_v<PacketHeader>,
              "it goes to the socket as it is in memory");

struct Packet {
  PacketHeader header{};
  std::span<const std::byte> payload{};  ///< Valid until the next receive.

  /// @brief The payload as what it was sent as. @pre it was sent by send_value() with this type.
  template <class T>
  [[nodiscard]] T value() const
  {
    return from_bytes<T>(payload);
  }
};

/// @brief A message on its way out, cut into packets. The bytes must live until it is sent.
class Outgoing {
 public:
  Outgoing(PacketKind kind, std::uint32_t call, std::span<const std::byte> bytes);

  /// @brief Sends as much as the socket takes without waiting.
  /// @return False if nobody will ever read it.
  bool send_some(int socket) { return send(socket, false); }

  /// @brief Sends all of it, waiting. @return False if nobody will ever read it.
  bool send_all(int socket) { return send(socket, true); }

  [[nodiscard]] bool is_sent() const noexcept { return sent_; }

 private:
  bool send(int socket, bool wait);

  PacketHeader header_;
  std::span<const std::byte> rest_;
  bool sent_ = false;
};

/// @brief Sends a value. @return False if nobody will ever read it.
template <class T>
bool send_value(int socket, PacketKind kind, std::uint32_t call, const T& value)
{
  return Outgoing(kind, call, to_bytes(value)).send_all(socket);
}

/// @brief Sends a packet without payload, never waits. @return False if it could not be sent.
bool send_signal(int socket, PacketKind kind, std::uint32_t call);

/// @brief Receives packets of one socket.
class Incoming {
 public:
  Incoming();

  /// @return The next packet; nothing if none is there, or ever will be: is_closed().
  [[nodiscard]] std::optional<Packet> receive(int socket, bool wait);

  [[nodiscard]] bool is_closed() const noexcept { return closed_; }

 private:
  std::vector<std::byte> buffer_;
  bool closed_ = false;
};

/// @brief Puts the packets of one message together.
class Assembly {
 public:
  /// @brief Adds a packet; one of another message than the last starts anew.
  /// @return Whether the message is complete.
  bool add(const Packet& packet);

  [[nodiscard]] const PacketHeader& header() const noexcept { return header_; }
  [[nodiscard]] Bytes take();  ///< The bytes of the complete message.

 private:
  PacketHeader header_{};
  Bytes bytes_{};
  bool complete_ = true;
};

}  // namespace tessera::jobs
