// SPDX-License-Identifier: BSD-3-Clause
// The program, but that its jobs fail as tests ask.
#include "pipeline/commands/tessera_main.hpp"

#include "faults/fault.hpp"
#include "faults/faulty_parts.hpp"

int main(int argc, char** argv)
{
  tessera::testing::replace_parts();
  return tessera::pipeline::tessera_main(argc, argv, tessera::testing::obey_test_environment);
}
