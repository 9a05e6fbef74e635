// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/ladder.hpp"

#include <algorithm>

namespace tessera::fill {

std::vector<FillTry> retry_ladder(const FillOptions& options)
{
  const FillTry asked{.grading = options.grading, .optimize_steps = options.optimize_steps};
  FillTry reordered = asked;
  reordered.point_order_seed = 1;
  FillTry relaxed{.grading = std::min(1.0, 2.0 * options.grading),
                  .optimize_steps = std::min(1, options.optimize_steps),
                  .point_order_seed = 2};
  FillTry plain = relaxed;
  plain.point_order_seed = 3;
  return {asked, reordered, relaxed, plain};
}

}  // namespace tessera::fill
