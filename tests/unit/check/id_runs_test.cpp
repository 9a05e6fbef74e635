// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/id_runs.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace tessera::check {
namespace {

TEST(IdRuns, ConsecutiveIdsAreOneRunInAnyOrder)
{
  std::vector<IdRun> runs;
  Findings findings;
  append_runs({7, 5, 6, 1, 8}, 3, cell_id_space(), runs, findings);
  EXPECT_EQ(runs, (std::vector<IdRun>{{1, 2, 3}, {5, 9, 3}}));
  EXPECT_TRUE(findings.to_defects().empty());
}

TEST(IdRuns, RunsOfDifferentPiecesStayApart)
{
  std::vector<IdRun> runs;
  Findings findings;
  append_runs({0, 1}, 0, cell_id_space(), runs, findings);
  append_runs({2, 3}, 1, cell_id_space(), runs, findings);
  EXPECT_EQ(runs.size(), 2U);
}

TEST(IdRuns, RepeatedIdsAreTwoRuns)
{
  std::vector<IdRun> runs;
  Findings findings;
  append_runs({4, 4}, 0, cell_id_space(), runs, findings);
  EXPECT_EQ(runs, (std::vector<IdRun>{{4, 5, 0}, {4, 5, 0}}));
}

TEST(IdRuns, IdsOutOfRangeAreReported)
{
  std::vector<IdRun> runs;
  Findings findings;
  append_runs({-3, std::numeric_limits<GlobalIndex>::max()}, 0, point_id_space(), runs, findings);
  EXPECT_TRUE(runs.empty());
  EXPECT_EQ(findings.count(Kind::point_id_hole), 2);
}

}  // namespace
}  // namespace tessera::check
