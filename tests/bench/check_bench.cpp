// SPDX-License-Identifier: BSD-3-Clause
// Speed and memory of the checker on a box of 8^LEVELS pieces of 6 N^3 tets, made in memory:
//   mpirun -n RANKS check_bench LEVELS N
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <mpi.h>
#include <sys/resource.h>

#include "tessera/check/check_mesh.hpp"

#include "support/box_pieces.hpp"

namespace tessera {
namespace {

// CPU time, so that what else runs on the machine does not matter.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// A source that takes the time it needs to make pieces, which is none of the checker's.
check::PieceSource timed(check::PieceSource source, double& seconds)
{
  source.read = [read = source.read, &seconds](LocalIndex piece) {
    const double begin = cpu_seconds();
    mesh::MeshArrays arrays = read(piece);
    seconds += cpu_seconds() - begin;
    return arrays;
  };
  return source;
}

void run(int levels, GlobalIndex n)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const testing::BoxPieces box(levels, n);
  double making = 0.0;
  const check::PieceSource tets =
      timed({box.num_pieces(), [&](LocalIndex p) { return box.tets(p); }}, making);
  const check::PieceSource boundary =
      timed({box.num_pieces(), [&](LocalIndex p) { return box.boundary(p); }}, making);

  const double begin = cpu_seconds();
  const check::CheckReport report = check::check_mesh(tets, &boundary, comm);
  const double busy = comm.max(cpu_seconds() - begin - making);
  const double peak = comm.max(peak_rss_bytes());
  if (comm.rank() != 0) return;
  const double surface = 12.0 * static_cast<double>(n * n * box.num_pieces());
  std::printf(
      "%s: %lld tets in %d pieces, %.0f surface triangles; %.2f s, %.2f M tets/s a rank; "
      "peak %.0f MB a rank, %.0f bytes of it per surface triangle\n",
      report.conforms ? "conforms" : "does NOT conform", static_cast<long long>(report.num_tets),
      box.num_pieces(), surface, busy,
      1e-6 * static_cast<double>(report.num_tets) / busy / comm.size(), 1e-6 * peak,
      peak * comm.size() / surface);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  if (argc == 3) tessera::run(std::atoi(argv[1]), std::atoi(argv[2]));
  MPI_Finalize();
  return argc == 3 ? 0 : 64;
}
