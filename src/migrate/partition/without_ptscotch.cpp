// SPDX-License-Identifier: BSD-3-Clause
// Stands in for scotch_partition.cpp in a build with TESSERA_WITH_PTSCOTCH=OFF.
#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/partition.hpp"

namespace tessera::migrate {

std::vector<LocalIndex> partition_tets(const comm::Communicator& /*comm*/,
                                       const DistributedMesh& mesh,
                                       const TetNeighbours& /*neighbours*/, LocalIndex num_parts,
                                       int /*seed*/)
{
  require_partitioner(num_parts);
  return std::vector<LocalIndex>(mesh.tet_ids.size(), 0);
}

void require_partitioner(LocalIndex num_parts)
{
  if (num_parts == 1) return;
  throw comm::Collective<ConfigError>(
      "this build of tessera has no PT-Scotch (it was configured with "
      "-DTESSERA_WITH_PTSCOTCH=OFF), which cuts meshes into parts; it can make one part");
}

std::string scotch_version() { return "none"; }

}  // namespace tessera::migrate
