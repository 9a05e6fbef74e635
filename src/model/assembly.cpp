// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/assembly.hpp"

#include <fmt/format.h>

namespace tessera::model {
namespace {

std::string point_text(const Vec3& p)
{
  return fmt::format("({:g}, {:g}, {:g})", p[0], p[1], p[2]);
}

std::string solid_text(const SolidPair& solids, std::size_t which)
{
  const std::string& name = solids.names[which];
  return fmt::format("solid {}{}", solids.numbers[which],
                     name.empty() ? "" : fmt::format(" '{}'", name));
}

}  // namespace

std::string words_of(const SolidPair& solids)
{
  return fmt::format("{} and {}", solid_text(solids, 0), solid_text(solids, 1));
}

std::string words_of(const CommonPart& part)
{
  return fmt::format("{} have a volume of {:.6g} in common, within {} to {}", words_of(part.solids),
                     part.volume, point_text(part.low), point_text(part.high));
}

std::string words_of(const ClosedGap& gap)
{
  return fmt::format("{} were {:.3g} apart, as at {}", words_of(gap.solids), gap.width,
                     point_text(gap.place));
}

}  // namespace tessera::model
