// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/migrate.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "tessera/base/error.hpp"

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
};
using Packets = RankBuckets<Packet>;

std::optional<std::string> defect_of(const DistributedMesh& mesh, std::span<const Rank> tet_rank,
                                     int num_ranks)
{
  if (tet_rank.size() != mesh.tet_ids.size()) return "migration: not one rank for each tet";
  for (const Rank rank : tet_rank) {
    if (rank < 0 || rank >= num_ranks) {
      return "migration: there is no rank " + std::to_string(rank);
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
      packet.sharers.values.insert(packet.sharers.values.end(), sharers.begin(), sharers.end());
      packet.sharers.end_list();
    }
  }
}

// Adds each vertex to the packets of the ranks that its tets go to.
// @return Row in that packet, parallel to destinations.values.
std::vector<LocalIndex> add_vertices(const DistributedMesh& mesh, const IndexLists& destinations,
                                     Packets& packets)
{
  std::vector<LocalIndex> rows;
  rows.reserve(destinations.values.size());
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    for (const Rank rank : destinations[v]) {
      MeshBlock& block = packets[rank].block;
      rows.push_back(block.num_vertices());
      block.vertex_ids.push_back(mesh.vertex_ids[at(v)]);
      const auto xyz = mesh.vertex_xyz.begin() + static_cast<std::ptrdiff_t>(3 * at(v));
      block.vertex_xyz.insert(block.vertex_xyz.end(), xyz, xyz + 3);
    }
  }
  return rows;
}

// Room for the tets and vertices to come: most of them stay, and growing would copy them again.
void reserve(std::span<const Rank> tet_rank, const IndexLists& destinations, int num_ranks,
             Packets& packets)
{
  std::vector<std::size_t> num_tets(static_cast<std::size_t>(num_ranks), 0);
  std::vector<std::size_t> num_vertices(num_tets.size(), 0);
  for (const Rank rank : tet_rank) ++num_tets[at(rank)];
  for (const Rank rank : destinations.values) ++num_vertices[at(rank)];
  for (std::size_t r = 0; r < num_tets.size(); ++r) {
    if (num_tets[r] == 0) continue;
    MeshBlock& block = packets[static_cast<Rank>(r)].block;
    block.vertex_ids.reserve(num_vertices[r]);
    block.vertex_xyz.reserve(3 * num_vertices[r]);
    block.tet_ids.reserve(num_tets[r]);
    block.tet_vertices.reserve(4 * num_tets[r]);
    block.tet_material.reserve(num_tets[r]);
    block.tet_part.reserve(num_tets[r]);
  }
}

// @return Row of each tet in its packet.
std::vector<LocalIndex> add_tets(const DistributedMesh& mesh, std::span<const Rank> tet_rank,
                                 const IndexLists& destinations, Packets& packets)
{
  const std::vector<LocalIndex> vertex_rows = add_vertices(mesh, destinations, packets);
  std::vector<LocalIndex> tet_rows;
  tet_rows.reserve(tet_rank.size());
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    MeshBlock& block = packets[tet_rank[at(t)]].block;
    for (const LocalIndex v : mesh.tet(t)) {
      auto entry = at(destinations.offsets[at(v)]);
      while (destinations.values[entry] != tet_rank[at(t)]) ++entry;
      block.tet_vertices.push_back(vertex_rows[entry]);
    }
    tet_rows.push_back(block.num_tets());
    block.tet_ids.push_back(mesh.tet_ids[at(t)]);
    block.tet_material.push_back(mesh.tet_material[at(t)]);
    block.tet_part.push_back(mesh.tet_part[at(t)]);
    block.tet_columns.resize(mesh.tet_columns.size());
    for (std::size_t c = 0; c < mesh.tet_columns.size(); ++c) {
      block.tet_columns[c].push_back(mesh.tet_columns[c][at(t)]);
    }
  }
  return tet_rows;
}

void add_boundary(const DistributedMesh& mesh, std::span<const Rank> tet_rank,
                  std::span<const LocalIndex> tet_rows, Packets& packets)
{
  for (std::size_t b = 0; b < mesh.boundary_ids.size(); ++b) {
    const LocalIndex tet = mesh.boundary_tet[b];
    MeshBlock& block = packets[tet_rank[at(tet)]].block;
    block.boundary_ids.push_back(mesh.boundary_ids[b]);
    block.boundary_tet.push_back(tet_rows[at(tet)]);
    block.boundary_corner.push_back(mesh.boundary_corner[b]);
    block.boundary_patch.push_back(mesh.boundary_patch[b]);
  }
}

Bytes to_bytes(const Packet& packet)
{
  ByteWriter out;
  put(packet.block, out);
  out.put(packet.shared_ids);
  out.put(packet.sharers.offsets);
  out.put(packet.sharers.values);
  return std::move(out).take();
}

Packet packet_from_bytes(const Bytes& bytes)
{
  ByteReader in(bytes);
  Packet packet;
  packet.block = get_block(in);
  packet.shared_ids = in.get_vector<GlobalIndex>();
  packet.sharers.offsets = in.get_vector<LocalIndex>();
  packet.sharers.values = in.get_vector<LocalIndex>();
  return packet;
}

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
    received.push_back(packet_from_bytes(message.bytes));
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
  reserve(tet_rank, destinations, comm.size(), packets);
  const std::vector<LocalIndex> tet_rows = add_tets(mesh, tet_rank, destinations, packets);
  add_boundary(mesh, tet_rank, tet_rows, packets);
  std::vector<Packet> received = deliver(comm, packets, counted);

  std::vector<MeshBlock> blocks;
  for (Packet& packet : received) blocks.push_back(std::move(packet.block));
  DistributedMesh migrated{merge_blocks(blocks)};
  migrated.tet_columns.resize(mesh.tet_columns.size());
  migrated.vertex_sharers = merge_sharers(received, migrated);
  return migrated;
}

}  // namespace tessera::migrate
