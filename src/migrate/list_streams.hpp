// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/migrate.hpp"

#include "migrate/rank_buckets.hpp"
#include "migrate/traffic.hpp"

namespace tessera::migrate {

/// @brief Lists for and from other ranks, each behind its length. Sender and receiver know in which
/// order they come.
template <class Index>
class ListStreams {
 public:
  explicit ListStreams(const comm::Communicator& comm) : comm_(comm), streams_(comm.size()) {}

  void put(Rank rank, std::span<const Index> list)
  {
    std::vector<Index>& values = streams_[rank].values;
    values.push_back(static_cast<Index>(list.size()));
    values.insert(values.end(), list.begin(), list.end());
  }

  void put(Rank rank, Index value) { put(rank, std::span<const Index>(&value, 1)); }

  /// @brief Sends what was put; afterwards there is what came. @note Collective.
  void exchange(Traffic& traffic)
  {
    std::vector<comm::Message> messages;
    for (const Rank rank : streams_.ranks()) {
      messages.push_back({rank, to_bytes(streams_[rank].values)});
    }
    streams_ = RankBuckets<Stream>(comm_.size());
    for (const comm::Message& message : migrate::exchange(comm_, std::move(messages), traffic)) {
      streams_[message.rank].values = from_bytes<std::vector<Index>>(message.bytes);
    }
  }

  /// @brief Ranks that sent something, ascending.
  [[nodiscard]] std::vector<Rank> senders() const { return streams_.ranks(); }

  /// @brief Whether there is one more list from that rank.
  [[nodiscard]] bool has_more(Rank rank)
  {
    const Stream& stream = streams_[rank];
    return stream.next < stream.values.size();
  }

  /// @brief Next list from a rank; it stays valid until the next exchange.
  /// @throws Error if there is none: the ranks do not agree about what they share.
  [[nodiscard]] std::span<const Index> get(Rank rank)
  {
    Stream& stream = streams_[rank];
    const auto rest = std::span<const Index>(stream.values).subspan(stream.next);
    if (rest.empty() || std::cmp_greater_equal(rest[0], rest.size())) {
      throw Error("the ranks do not agree about the vertices they share");
    }
    const auto size = static_cast<std::size_t>(rest[0]);
    stream.next += 1 + size;
    return rest.subspan(1, size);
  }

 private:
  struct Stream {
    std::vector<Index> values{};
    std::size_t next = 0;
  };

  const comm::Communicator& comm_;
  RankBuckets<Stream> streams_;
};

}  // namespace tessera::migrate
