// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/given_up.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace tessera {

void note_given_up(std::string_view what, const std::exception& why)
{
  fmt::print(stderr, "given up: {}: {}\n", what, why.what());
}

}  // namespace tessera
