// SPDX-License-Identifier: BSD-3-Clause
// Its own main(): MPI runs before there is a Session, as in a program that knew nothing of it.
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "tessera/tessera.hpp"

#include "support/mpi_tests.hpp"

namespace tessera {
namespace {

bool has_session = false;

TEST(NoSession, MakeMeshRefusesOnAllRanksIfOneHasNone)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  EXPECT_GT(comm.sum(has_session ? 0 : 1), 0);
  config::Case given;
  given.geometry.file = "not looked at.geo";
  try {
    static_cast<void>(make_mesh(given, comm));
    ADD_FAILURE() << "made a mesh";
  } catch (const comm::Collective<UsageError>& error) {
    EXPECT_NE(std::string(error.what()).find("constructed in main() before MPI_Init"),
              std::string::npos);
  }
}

TEST(NoSession, ASessionAfterMpiInitIsRefusedWithTheWayOut)
{
  try {
    const Session late;
    ADD_FAILURE() << "made a Session";
  } catch (const UsageError& error) {
    const std::string expected = has_session ? "already" : "before MPI_Init";
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos);
  }
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  // On one of several ranks, as far as that can be known before MPI starts.
  std::unique_ptr<tessera::Session> session;
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  if (rank != nullptr && std::atoi(rank) == 1) session = std::make_unique<tessera::Session>();
  tessera::has_session = session != nullptr;
  MPI_Init(&argc, &argv);
  const int failed = tessera::testing::run_tests_on_all_ranks(argc, argv);
  MPI_Finalize();
  return failed;
}
