// SPDX-License-Identifier: BSD-3-Clause
#include "formats/limits.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::formats {

void require_32_bit_numbers(const Outline& outline, io::Format format)
{
  constexpr GlobalIndex kMost = std::numeric_limits<std::int32_t>::max();
  if (std::max(outline.num_points(), outline.num_cells()) <= kMost) return;
  throw ConfigError(fmt::format(
      "the mesh has {} cells and {} points; readers of {} take {} at most; {} has no such limit",
      outline.num_cells(), outline.num_points(), word_of(format), kMost,
      word_of(io::Format::xdmf)));
}

}  // namespace tessera::formats
