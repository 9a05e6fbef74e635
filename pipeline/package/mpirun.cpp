// SPDX-License-Identifier: BSD-3-Clause
// mpirun of the Open MPI that is packed with the program: `tessera-mpirun -n 2 tessera mesh ...`.
#include <cstdio>

#include <unistd.h>

#include "pipeline/runtime/installed.hpp"

int main(int, char** argv)
{
  const auto folder = tessera::pipeline::mpi_inside();
  if (folder) {
    tessera::pipeline::use_mpi_inside(*folder);
    // With a path there mpirun would put its folders before those of the ranks.
    char name[] = "mpirun";
    argv[0] = name;
    ::execv((*folder / "orterun").c_str(), argv);
  }
  std::fputs("tessera-mpirun: no Open MPI was packed with it, or it cannot be started\n", stderr);
  return 69;
}
