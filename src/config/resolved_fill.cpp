// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tessera/config/case.hpp"

namespace tessera::config {
namespace {

// checkMesh calls a cell under-determined that has all corners on walls.
bool wants_no_corner_tets(io::Format format)
{
  return format == io::Format::openfoam || format == io::Format::openfoam_serial;
}

}  // namespace

fill::FillOptions resolved_fill(const Case& given, bool is_partial)
{
  fill::FillOptions fill = given.fill;
  const bool is_wanted = std::ranges::any_of(given.output.formats, wants_no_corner_tets);
  if (!fill.split_corners && (is_wanted || is_partial)) fill.split_corners = !is_partial;
  if (fill.levels == 0 && given.output.order == 2) fill.levels = fill::kAllLevels;
  return fill;
}

}  // namespace tessera::config
