// SPDX-License-Identifier: BSD-3-Clause
// A program with a mistake: one rank does not come to where all must.
//   missing_rank_program world|make_mesh|read_mesh|throw RANK
// That rank waits for the others in a barrier. With "throw" it has thrown, and waits at the end of
// the Session. Without an end of the front door's own, nothing would ever end it.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tessera/tessera.hpp"

namespace {

constexpr double kTimeout_s = 0.5;

void call(const std::string& function, const tessera::Session& session, bool is_missing)
{
  if (function == "world") {
    if (!is_missing) static_cast<void>(session.world(kTimeout_s));
    return;
  }
  const tessera::comm::Communicator world = session.world();
  if (is_missing && function == "throw") throw std::runtime_error("of the program");
  if (is_missing) return;
  if (function == "read_mesh") {
    static_cast<void>(tessera::read_mesh("never read", world, {.rank_timeout_s = kTimeout_s}));
  } else {
    static_cast<void>(tessera::make_mesh({}, world, {.rank_timeout_s = kTimeout_s}));
  }
}

}  // namespace

int main(int argc, char** argv)
{
  const tessera::Session session(argc, argv);
  if (argc != 3) return EXIT_FAILURE;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    call(argv[1], session, rank == std::atoi(argv[2]));
  } catch (const tessera::UsageError&) {
    return EXIT_FAILURE;  // Says nothing: the Session does.
  } catch (const std::runtime_error&) {
    return EXIT_FAILURE;
  }
  MPI_Barrier(MPI_COMM_WORLD);
  std::puts("all ranks are here");
  return EXIT_SUCCESS;
}
