// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace tessera::pipeline {

/// @brief Which jobs of one kernel a dry run does in earnest, to learn what the others will cost.
struct SampleChoice {
  int levels = 0;  ///< At which they are filled; fewer than asked for where even a
                   ///< few jobs would take too long. Each level less is 8 times less.
  std::vector<std::size_t> jobs{};  ///< Rows of the list of costs, the largest first.
};

/// @brief Chooses the jobs to be done as samples. Local.
///
/// First the largest, since its memory and time bound the run's; then the median, the quartiles and
/// the octiles, as far as the budget goes. The budget is a fifth of all work, but 5 s to 20 s of
/// CPU time. At least three jobs are chosen, or two where only two fit, or all if there are fewer.
/// At most eight are chosen, or half of the jobs. A pure function of the coarse mesh, so it is the
/// same for any number of ranks.
/// @param[in] cost_s CPU time that each job should take with all levels, seconds, > 0.
[[nodiscard]] SampleChoice choose_samples(const std::vector<double>& cost_s, int levels);

}  // namespace tessera::pipeline
