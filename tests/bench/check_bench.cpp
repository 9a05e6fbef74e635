// SPDX-License-Identifier: BSD-3-Clause
// Speed and memory of the checker on a box of 8^LEVELS pieces of 6 N^3 tets, made in memory:
//   mpirun -n RANKS check_bench LEVELS N
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <mpi.h>
#include <sys/resource.h>

#include "tessera/check/check_mesh.hpp"

#include "support/box_pieces.hpp"

namespace tessera {
namespace {

using Clock = std::chrono::steady_clock;

double peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// A source that takes the time it needs to make pieces, which is none of the checker's.
check::PieceSource timed(check::PieceSource source, Clock::duration& seconds)
{
  source.read = [read = source.read, &seconds](LocalIndex piece) {
    const auto begin = Clock::now();
    mesh::MeshArrays arrays = read(piece);
    seconds += Clock::now() - begin;
    return arrays;
  };
  return source;
}

void run(int levels, GlobalIndex n)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const testing::BoxPieces box(levels, n);
  Clock::duration making{};
  const check::PieceSource tets =
      timed({box.num_pieces(), [&](LocalIndex p) { return box.tets(p); }}, making);
  const check::PieceSource boundary =
      timed({box.num_pieces(), [&](LocalIndex p) { return box.boundary(p); }}, making);

  const auto begin = Clock::now();
  const check::CheckReport report = check::check_mesh(tets, &boundary, comm);
  const std::chrono::duration<double> busy = Clock::now() - begin - making;
  const double mean_busy = comm.max(busy.count());
  const double peak = comm.max(peak_rss_bytes());
  if (comm.rank() != 0) return;
  const double surface = 12.0 * static_cast<double>(n * n * box.num_pieces());
  std::printf(
      "%s: %lld tets in %d pieces, %.0f surface triangles; %.2f s, %.2f M tets/s a rank; "
      "peak %.0f MB a rank, %.0f bytes of it per surface triangle\n",
      report.conforms ? "conforms" : "does NOT conform", static_cast<long long>(report.num_tets),
      box.num_pieces(), surface, mean_busy,
      1e-6 * static_cast<double>(report.num_tets) / mean_busy / comm.size(), 1e-6 * peak,
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
