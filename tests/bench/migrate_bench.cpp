// SPDX-License-Identifier: BSD-3-Clause
// Speed and messages of migration on a box of 6 N^3 tets a rank, made in memory:
//   mpirun -n RANKS migrate_bench random N     10 % of each rank's tets to random other ranks
//   mpirun -n RANKS migrate_bench layer N      10 % of each rank's tets to the ranks beside it
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include <mpi.h>

#include "tessera/migrate/assemble.hpp"
#include "tessera/migrate/migrate.hpp"
#include "tessera/migrate/tet_neighbours.hpp"

#include "support/box_pieces.hpp"

namespace tessera {
namespace {

constexpr int kPercent = 10;

// Waiting for messages included, but not the time that others have the core.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The first pieces of a box of 8^levels, one a rank: neighbours in space have neighbouring numbers.
migrate::DistributedMesh make_mesh(const comm::Communicator& comm, GlobalIndex n)
{
  int levels = 0;
  while ((1 << (3 * levels)) < comm.size()) ++levels;
  const testing::BoxPieces box(levels, n);
  migrate::MeshPieces pieces;
  pieces.tets.push_back(box.tets(comm.rank()));
  return migrate::assemble(comm, pieces).mesh;
}

std::vector<Rank> to_random_ranks(const comm::Communicator& comm, LocalIndex num_tets,
                                  std::mt19937& random)
{
  std::vector<Rank> ranks(at(num_tets), comm.rank());
  for (Rank& rank : ranks) {
    if (comm.size() == 1 || random() % 100 >= kPercent) continue;
    const auto step = 1 + static_cast<int>(random() % static_cast<unsigned>(comm.size() - 1));
    rank = (rank + step) % comm.size();
  }
  return ranks;
}

// Tets beside those of other ranks, then those beside them, until there are enough.
std::vector<Rank> to_neighbours(const comm::Communicator& comm,
                                const migrate::DistributedMesh& mesh)
{
  const migrate::TetNeighbours neighbours = migrate::find_neighbours(comm, mesh);
  std::vector<Rank> ranks(mesh.tet_ids.size(), comm.rank());
  std::vector<LocalIndex> queue;
  for (const migrate::RemoteFace& face : neighbours.remote) {
    if (ranks[at(face.tet)] == comm.rank()) queue.push_back(face.tet);
    ranks[at(face.tet)] = face.rank;
  }
  const std::size_t num_wanted = std::max(queue.size(), ranks.size() * kPercent / 100);
  for (std::size_t i = 0; i < queue.size() && queue.size() < num_wanted; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex next = neighbours.behind[4 * at(queue[i]) + c];
      if (next < 0 || next >= mesh.num_tets() || ranks[at(next)] != comm.rank()) continue;
      ranks[at(next)] = ranks[at(queue[i])];
      queue.push_back(next);
    }
  }
  return ranks;
}

// The different ranks that this one shares vertices with.
std::size_t num_neighbour_ranks(const migrate::DistributedMesh& mesh)
{
  std::vector<LocalIndex> ranks = mesh.vertex_sharers.values.to_vector();
  std::ranges::sort(ranks);
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks.empty() ? 0 : ranks.size() - 1;
}

void run(bool is_random, GlobalIndex n)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const migrate::DistributedMesh mesh = make_mesh(comm, n);
  std::mt19937 random(static_cast<unsigned>(comm.rank()) + 1);
  const std::vector<Rank> ranks =
      is_random ? to_random_ranks(comm, mesh.num_tets(), random) : to_neighbours(comm, mesh);
  const auto num_moved =
      ranks.size() - static_cast<std::size_t>(std::ranges::count(ranks, comm.rank()));
  constexpr int kRepetitions = 5;
  double best = 1e300;
  double best_cpu = 1e300;
  migrate::Traffic traffic;
  for (int i = 0; i < kRepetitions; ++i) {
    comm.barrier();
    traffic = {};
    const double begin = MPI_Wtime();
    const double cpu_begin = cpu_seconds();
    const auto migrated = migrate::migrate(comm, mesh, ranks, &traffic);
    const double cpu = cpu_seconds() - cpu_begin;
    best = std::min(best, comm.max(MPI_Wtime() - begin));
    best_cpu = std::min(best_cpu, comm.max(cpu));
  }
  const auto neighbours = comm.max(static_cast<double>(num_neighbour_ranks(mesh)));
  const double messages = comm.max(static_cast<double>(traffic.num_messages));
  const double bytes = comm.max(static_cast<double>(traffic.num_bytes));
  const auto moved = static_cast<double>(comm.sum(static_cast<GlobalIndex>(num_moved)));
  if (comm.rank() != 0) return;
  std::printf(
      "%d ranks, %d tets each, %.0f moved in all: best of %d %.3f s, %.3f s of CPU, %.2f M moved "
      "tets/s a rank and second of CPU; at most %.0f neighbours, %.0f messages, %.2f MB sent by a "
      "rank\n",
      comm.size(), mesh.num_tets(), moved, kRepetitions, best, best_cpu,
      1e-6 * moved / best_cpu / comm.size(), neighbours, messages, 1e-6 * bytes);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  const std::string how = argc == 3 ? argv[1] : "";
  const bool is_good = how == "random" || how == "layer";
  if (is_good) tessera::run(how == "random", std::atoi(argv[2]));
  MPI_Finalize();
  return is_good ? 0 : 64;
}
