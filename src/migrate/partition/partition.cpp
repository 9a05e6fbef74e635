// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/partition.hpp"

#include "migrate/sharer_lists.hpp"

namespace tessera::migrate {

Rank rank_of_part(LocalIndex part, LocalIndex num_parts, int num_ranks)
{
  return static_cast<Rank>((GlobalIndex{num_ranks} * (part + 1) - 1) / num_parts);
}

IndexLists parts_of_vertices(const comm::Communicator& comm, const DistributedMesh& mesh)
{
  Traffic traffic;
  const IndexLists mine = values_around_vertices(mesh, mesh.tet_part);
  return lists_from_owners(comm, mesh, unite_at_owners(comm, mesh, mine, traffic), traffic);
}

}  // namespace tessera::migrate
