// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/sharer_lists.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "tessera/base/error.hpp"

#include "migrate/rank_buckets.hpp"
#include "migrate/traffic.hpp"

namespace tessera::migrate {
namespace {

// Lists for and from other ranks, each behind its length.
class ListStreams {
 public:
  explicit ListStreams(const comm::Communicator& comm) : comm_(comm), streams_(comm.size()) {}

  void put(Rank rank, std::span<const LocalIndex> list)
  {
    std::vector<LocalIndex>& values = streams_[rank].values;
    values.push_back(static_cast<LocalIndex>(list.size()));
    values.insert(values.end(), list.begin(), list.end());
  }

  // Next list from a rank; it stays valid until the next exchange.
  [[nodiscard]] std::span<const LocalIndex> get(Rank rank)
  {
    Stream& stream = streams_[rank];
    const auto rest = std::span<const LocalIndex>(stream.values).subspan(stream.next);
    if (rest.empty() || std::cmp_greater_equal(rest[0], rest.size())) {
      throw Error("the ranks do not agree about the vertices they share");
    }
    stream.next += 1 + at(rest[0]);
    return rest.subspan(1, at(rest[0]));
  }

  // Sends what was put; then get() gives what came. Collective.
  void exchange(Traffic& traffic)
  {
    std::vector<comm::Message> messages;
    for (const Rank rank : streams_.ranks()) {
      const auto bytes = std::as_bytes(std::span(streams_[rank].values));
      messages.push_back({rank, Bytes(bytes.begin(), bytes.end())});
    }
    streams_ = RankBuckets<Stream>(comm_.size());
    for (const comm::Message& message : migrate::exchange(comm_, std::move(messages), traffic)) {
      std::vector<LocalIndex>& values = streams_[message.rank].values;
      values.resize(message.bytes.size() / sizeof(LocalIndex));
      std::memcpy(values.data(), message.bytes.data(), values.size() * sizeof(LocalIndex));
    }
  }

 private:
  struct Stream {
    std::vector<LocalIndex> values{};
    std::size_t next = 0;
  };

  const comm::Communicator& comm_;
  RankBuckets<Stream> streams_;
};

void append(IndexLists& lists, std::span<const LocalIndex> list)
{
  lists.values.insert(lists.values.end(), list.begin(), list.end());
}

}  // namespace

IndexLists unite_at_owners(const comm::Communicator& comm, const DistributedMesh& mesh,
                           const IndexLists& lists, Traffic& traffic)
{
  ListStreams streams(comm);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const Rank owner = mesh.owner(v, comm.rank());
    if (owner != comm.rank()) streams.put(owner, lists[v]);
  }
  streams.exchange(traffic);

  IndexLists united;
  united.offsets.reserve(lists.offsets.size());
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const auto sharers = mesh.vertex_sharers[v];
    if (sharers.empty() || sharers.front() == comm.rank()) {
      const auto begin = static_cast<std::ptrdiff_t>(united.values.size());
      append(united, lists[v]);
      for (std::size_t s = 1; s < sharers.size(); ++s) append(united, streams.get(sharers[s]));
      if (sharers.size() > 1) {
        std::sort(united.values.begin() + begin, united.values.end());
        united.values.erase(std::unique(united.values.begin() + begin, united.values.end()),
                            united.values.end());
      }
    }
    united.end_list();
  }
  return united;
}

IndexLists lists_from_owners(const comm::Communicator& comm, const DistributedMesh& mesh,
                             const IndexLists& lists, Traffic& traffic)
{
  ListStreams streams(comm);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const auto sharers = mesh.vertex_sharers[v];
    if (sharers.empty() || sharers.front() != comm.rank()) continue;
    for (const Rank sharer : sharers.subspan(1)) streams.put(sharer, lists[v]);
  }
  streams.exchange(traffic);

  IndexLists all;
  all.offsets.reserve(lists.offsets.size());
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const Rank owner = mesh.owner(v, comm.rank());
    append(all, owner == comm.rank() ? lists[v] : streams.get(owner));
    all.end_list();
  }
  return all;
}

}  // namespace tessera::migrate
