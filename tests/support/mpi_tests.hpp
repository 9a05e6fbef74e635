// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::testing {

/// @brief Runs all tests on all ranks: rank 0 prints, the others print failures only.
/// @pre MPI runs.
/// @note Collective.
/// @return The same exit code on every rank.
[[nodiscard]] int run_tests_on_all_ranks(int& argc, char** argv);

}  // namespace tessera::testing
