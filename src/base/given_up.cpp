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
  const std::string times =
      num_given_up_ == 1 ? "" : " " + std::to_string(num_given_up_) + " times";
  std::fprintf(stderr, "given up%s: %s: %s\n", times.c_str(), what_.c_str(), first_reason_.c_str());
}

}  // namespace tessera
