// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/size_warning.hpp"

#include <fmt/format.h>

namespace tessera::pipeline {
namespace {

// In wanted sizes. A mesh is made finer from 1.5 on; where that works, some edges still have as
// much, and next to none twice the size.
constexpr double kMost = 2.0;

}  // namespace

std::optional<std::string> size_warning(const CoarseResult& coarse)
{
  const sizing::PartInSizes& longest = coarse.missed_size;
  if (longest.in_sizes == 0.0) return std::nullopt;
  return fmt::format(
      "no finer coarse mesh could be made for the wanted sizes, so the one before stays: near "
      "({:.6g}) "
      "edges of {:.3g} are wanted, and they are up to {:.3g} times as long",
      fmt::join(longest.place, ", "), longest.size, longest.in_sizes);
}

bool misses_sizes(const CoarseResult& coarse) { return coarse.missed_size.in_sizes > kMost; }

}  // namespace tessera::pipeline
