// SPDX-License-Identifier: BSD-3-Clause
// main() of tests that mesh: it has a Session.
#include "mpi/front_door/session_main.hpp"

#include "support/mpi_tests.hpp"

namespace tessera::testing {
namespace {

Session* session_made_by_main = nullptr;

}  // namespace

Session& session_of_this_process() { return *session_made_by_main; }

}  // namespace tessera::testing

int main(int argc, char** argv)
{
  tessera::Session session;
  tessera::testing::session_made_by_main = &session;
  MPI_Init(&argc, &argv);
  const int failed = tessera::testing::run_tests_on_all_ranks(argc, argv);
  MPI_Finalize();
  return failed;
}
