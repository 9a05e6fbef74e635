// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/sharer_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "migrate/list_streams.hpp"

namespace tessera::migrate {
namespace {

void append(IndexLists& lists, std::span<const LocalIndex> list)
{
  lists.values.insert(lists.values.end(), list.begin(), list.end());
}

}  // namespace

IndexLists unite_at_owners(const comm::Communicator& comm, const DistributedMesh& mesh,
                           const IndexLists& lists, Traffic& traffic)
{
  ListStreams<LocalIndex> streams(comm);
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
  ListStreams<LocalIndex> streams(comm);
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
    all.add(owner == comm.rank() ? lists[v] : streams.get(owner));
  }
  return all;
}

std::vector<GlobalIndex> values_from_owners(const comm::Communicator& comm,
                                            const DistributedMesh& mesh,
                                            std::vector<GlobalIndex> values, Traffic& traffic)
{
  ListStreams<GlobalIndex> streams(comm);
  for (LocalIndex v = 0; v < mesh.vertex_sharers.num_lists(); ++v) {
    const auto sharers = mesh.vertex_sharers[v];
    if (sharers.empty() || sharers.front() != comm.rank()) continue;
    for (const Rank sharer : sharers.subspan(1)) streams.put(sharer, values[at(v)]);
  }
  streams.exchange(traffic);
  for (LocalIndex v = 0; v < mesh.vertex_sharers.num_lists(); ++v) {
    const Rank owner = mesh.owner(v, comm.rank());
    if (owner != comm.rank()) values[at(v)] = streams.get(owner).front();
  }
  return values;
}

}  // namespace tessera::migrate
