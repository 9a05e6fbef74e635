// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "tessera/fill/kernel.hpp"
#include "tessera/improve/optimizer.hpp"

namespace tessera::pipeline {

/// @brief The kernel itself, or one that fails for real as the environment variable
/// TESSERA_TEST_FAULT asks: "fill=KIND@SUBDOMAIN" with KIND in throw, segv, exit, loop, sleep,
/// memory, drop (loses a tet). For the tests of the ladder: no option, for no user needs it.
/// @throws ConfigError if the variable has no such form.
[[nodiscard]] std::unique_ptr<fill::Kernel> make_faulty_if_asked(
    std::unique_ptr<fill::Kernel> kernel, LocalIndex subdomain);

/// @brief The same for the improvement of seams: "improve=KIND@REGION".
[[nodiscard]] std::unique_ptr<improve::Optimizer> make_faulty_if_asked(
    std::unique_ptr<improve::Optimizer> optimizer, LocalIndex region);

}  // namespace tessera::pipeline
