// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/find_sharers.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>

#include "tessera/comm/record_exchange.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "migrate/list_streams.hpp"

namespace tessera::migrate {
namespace {

struct Record {
  VertexKey key{};
  Vec3 position{};
  Rank rank = 0;
  LocalIndex vertex = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.key, self.position, self.rank, self.vertex);
  }
};

std::vector<Record> surface_records(const JoinedTets& joined, const std::vector<LocalIndex>& behind,
                                    Rank rank)
{
  std::vector<bool> is_on_surface(joined.vertex_keys.size(), false);
  for (std::size_t side = 0; side < behind.size(); ++side) {
    if (behind[side] != kNoIndex) continue;
    const auto tet = joined.block.tet(static_cast<LocalIndex>(side / 4));
    for (const std::size_t c : mesh::kTetFaceCorners[side % 4]) is_on_surface[at(tet[c])] = true;
  }
  std::vector<Record> records;
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(joined.vertex_keys.size()); ++v) {
    if (!is_on_surface[at(v)]) continue;
    records.push_back({joined.vertex_keys[at(v)], joined.block.position(v), rank, v});
  }
  return records;
}

// Tells every rank of a group about the others: (vertex there, ranks…).
void tell(std::span<const Record> received, std::span<const std::size_t> rows,
          ListStreams<LocalIndex>& streams)
{
  if (rows.size() < 2) return;
  std::vector<LocalIndex> list(1);
  for (const std::size_t row : rows) list.push_back(received[row].rank);
  for (const std::size_t row : rows) {
    list[0] = received[row].vertex;
    streams.put(received[row].rank, list);
  }
}

IndexLists sorted_by_vertex(ListStreams<LocalIndex>& streams, std::size_t num_vertices)
{
  std::vector<std::span<const LocalIndex>> of_vertex(num_vertices);
  for (const Rank rank : streams.senders()) {
    while (streams.has_more(rank)) {
      const auto list = streams.get(rank);
      of_vertex[at(list[0])] = list.subspan(1);
    }
  }
  IndexLists sharers;
  sharers.offsets.reserve(num_vertices + 1);
  for (const auto list : of_vertex) sharers.add(list);
  return sharers;
}

}  // namespace

FoundSharers find_sharers(const comm::Communicator& comm, const JoinedTets& joined,
                          const std::vector<LocalIndex>& behind)
{
  const std::vector<Record> records = surface_records(joined, behind, comm.rank());
  const comm::RecordExchange<Record> exchange(
      records, [](const Record& record) { return hash_of(record.key); }, comm);
  bool has_contradiction = joined.has_contradiction;
  ListStreams<LocalIndex> streams(comm);
  comm::for_each_group(
      exchange.received(), [](const Record& record) { return record.key; },
      [](const Record& record) { return record.rank; },
      [&](std::span<const std::size_t> rows) {
        const std::span<const Record> received = exchange.received();
        for (const std::size_t row : rows) {
          if (received[row].position != received[rows[0]].position) has_contradiction = true;
        }
        tell(received, rows, streams);
      });
  Traffic traffic;
  streams.exchange(traffic);
  return {sorted_by_vertex(streams, joined.vertex_keys.size()),
          comm.sum(has_contradiction ? 1 : 0) > 0};
}

}  // namespace tessera::migrate
