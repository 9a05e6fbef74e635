// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/given_up.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace tessera {

void note_given_up(std::string_view what, const std::exception& why)
{
  fmt::print(stderr, "given up: {}: {}\n", what, why.what());
}

void Attempts::note(const std::exception& why)
{
  if (num_given_up_++ == 0) first_reason_ = why.what();
}

Attempts::~Attempts()
{
  if (num_given_up_ == 0) return;
  const std::string times = num_given_up_ == 1 ? "" : fmt::format(" {} times", num_given_up_);
  fmt::print(stderr, "given up{}: {}: {}\n", times, what_, first_reason_);
}

}  // namespace tessera
