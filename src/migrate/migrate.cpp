// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/migrate.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/rows.hpp"

#include "migrate/block_merge.hpp"
#include "migrate/rank_buckets.hpp"
#include "migrate/sharer_lists.hpp"
#include "migrate/traffic.hpp"

namespace tessera::migrate {
namespace {

// What one rank gets: tets, and the sharers of vertices that it shares from now on.
struct Packet {
  MeshBlock block{};
  std::vector<GlobalIndex> shared_ids{};
  IndexLists sharers{};  // Parallel to shared_ids.

  static auto fields(auto& self) { return std::tie(self.block, self.shared_ids, self.sharers); }
};
using Packets = RankBuckets<Packet>;

std::optional<std::string> defect_of(const DistributedMesh& mesh, std::span<const Rank> tet_rank,
                                     int num_ranks)
{
  if (tet_rank.size() != mesh.tet_ids.size()) return "migration: not one rank for each tet";
  for (const Rank rank : tet_rank) {
    if (rank < 0 || rank >= num_ranks) {
      return fmt::format("migration: there is no rank {}", rank);
    }
  }
  return std::nullopt;
}

// The new sharers of each vertex, told by its old owner.
void add_sharers(const DistributedMesh& mesh, const IndexLists& new_sharers, Packets& packets)
{
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const auto sharers = new_sharers[v];
    if (sharers.size() < 2) continue;
    for (const Rank sharer : sharers) {
      Packet& packet = packets[sharer];
      packet.shared_ids.push_back(mesh.vertex_ids[at(v)]);
      packet.sharers.add(sharers);
    }
  }
}

// What of this rank's mesh goes to one rank: ascending rows.
struct Leaving {
  std::vector<LocalIndex> vertices{};
  std::vector<LocalIndex> tets{};
  std::vector<LocalIndex> boundary{};
};

RankBuckets<Leaving> rows_by_rank(const DistributedMesh& mesh, std::span<const Rank> tet_rank,
                                  const IndexLists& destinations, int num_ranks)
{
  RankBuckets<Leaving> leaving(num_ranks);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    for (const Rank rank : destinations[v]) leaving[rank].vertices.push_back(v);
  }
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) leaving[tet_rank[at(t)]].tets.push_back(t);
  for (LocalIndex b = 0; b < mesh.num_boundary(); ++b) {
    leaving[tet_rank[at(mesh.boundary_tet[at(b)])]].boundary.push_back(b);
  }
  return leaving;
}

// Cuts blocks out of a mesh; the places of vertices and tets in a block are kept in arrays that all
// blocks use one after the other.
class BlockCutter {
 public:
  explicit BlockCutter(const DistributedMesh& mesh)
      : mesh_(mesh), vertex_row_(mesh.vertex_ids.size()), tet_row_(mesh.tet_ids.size())
  {
  }

  [[nodiscard]] MeshBlock cut(const Leaving& leaving)
  {
    number(leaving.vertices, vertex_row_);
    number(leaving.tets, tet_row_);
    MeshBlock block;
    block.vertex_ids = rows_of(mesh_.vertex_ids, leaving.vertices);
    block.vertex_xyz = rows_of<3>(mesh_.vertex_xyz, leaving.vertices);
    block.tet_ids = rows_of(mesh_.tet_ids, leaving.tets);
    block.tet_vertices = rows_of<4>(mesh_.tet_vertices, leaving.tets);
    block.tet_material = rows_of(mesh_.tet_material, leaving.tets);
    block.tet_part = rows_of(mesh_.tet_part, leaving.tets);
    for (const auto& column : mesh_.tet_columns) {
      block.tet_columns.push_back(rows_of(column, leaving.tets));
    }
    block.boundary_ids = rows_of(mesh_.boundary_ids, leaving.boundary);
    block.boundary_tet = rows_of(mesh_.boundary_tet, leaving.boundary);
    block.boundary_corner = rows_of(mesh_.boundary_corner, leaving.boundary);
    block.boundary_patch = rows_of(mesh_.boundary_patch, leaving.boundary);
    for (LocalIndex& v : block.tet_vertices) v = vertex_row_[at(v)];
    for (LocalIndex& t : block.boundary_tet) t = tet_row_[at(t)];
    return block;
  }

 private:
  static void number(std::span<const LocalIndex> rows, std::vector<LocalIndex>& row_in_block)
  {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      row_in_block[at(rows[i])] = static_cast<LocalIndex>(i);
    }
  }

  const DistributedMesh& mesh_;
  std::vector<LocalIndex> vertex_row_;
  std::vector<LocalIndex> tet_row_;
};

// Sends the packets and returns those for this rank; the one that it keeps is not copied.
std::vector<Packet> deliver(const comm::Communicator& comm, Packets& packets, Traffic& traffic)
{
  std::vector<Packet> received;
  std::vector<comm::Message> messages;
  for (const Rank rank : packets.ranks()) {
    if (rank == comm.rank())
      received.push_back(std::move(packets[rank]));
    else
      messages.push_back({rank, to_bytes(packets[rank])});
  }
  for (comm::Message& message : exchange(comm, std::move(messages), traffic)) {
    received.push_back(from_bytes<Packet>(message.bytes));
    message.bytes = {};
  }
  return received;
}

// Every vertex that is shared from now on is in the list of one packet, that of its old owner.
IndexLists merge_sharers(std::span<const Packet> packets, const MeshBlock& merged)
{
  IndexLists sharers;
  sharers.offsets.assign(merged.vertex_ids.size() + 1, 0);
  std::vector<std::vector<LocalIndex>> places;
  for (const Packet& packet : packets) {
    places.push_back(places_of(packet.shared_ids, merged.vertex_ids));
    for (std::size_t i = 0; i < packet.shared_ids.size(); ++i) {
      sharers.offsets[at(places.back()[i]) + 1] =
          static_cast<LocalIndex>(packet.sharers[static_cast<LocalIndex>(i)].size());
    }
  }
  for (std::size_t v = 0; v < merged.vertex_ids.size(); ++v) {
    sharers.offsets[v + 1] += sharers.offsets[v];
  }
  sharers.values.resize(at(sharers.offsets.back()));
  for (std::size_t p = 0; p < packets.size(); ++p) {
    for (std::size_t i = 0; i < places[p].size(); ++i) {
      std::ranges::copy(packets[p].sharers[static_cast<LocalIndex>(i)],
                        sharers.values.begin() + sharers.offsets[at(places[p][i])]);
    }
  }
  return sharers;
}

}  // namespace

DistributedMesh migrate(const comm::Communicator& comm, const DistributedMesh& mesh,
                        std::span<const Rank> tet_rank, Traffic* traffic)
{
  comm.throw_if_any<MeshError>(defect_of(mesh, tet_rank, comm.size()));
  Traffic unasked;
  Traffic& counted = traffic == nullptr ? unasked : *traffic;

  const IndexLists destinations = values_around_vertices(mesh, tet_rank);
  const IndexLists new_sharers = unite_at_owners(comm, mesh, destinations, counted);
  Packets packets(comm.size());
  add_sharers(mesh, new_sharers, packets);
  auto leaving = rows_by_rank(mesh, tet_rank, destinations, comm.size());
  BlockCutter cutter(mesh);
  for (const Rank rank : leaving.ranks()) packets[rank].block = cutter.cut(leaving[rank]);
  std::vector<Packet> received = deliver(comm, packets, counted);

  std::vector<MeshBlock> blocks;
  blocks.reserve(received.size());
  for (Packet& packet : received) blocks.push_back(std::move(packet.block));
  DistributedMesh migrated{merge_blocks(blocks)};
  migrated.tet_columns.resize(mesh.tet_columns.size());
  migrated.vertex_sharers = merge_sharers(received, migrated);
  return migrated;
}

}  // namespace tessera::migrate
