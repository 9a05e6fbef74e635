// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/stages/fill/untangle_and_fill.hpp"

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

mesh::ProjectionLimiter one_limit(double factor)
{
  return mesh::ProjectionLimiter({{{mesh::LatticeCarrier::edge, 3, 0}, factor}});
}

Plan plan_of_four()
{
  return {.kernels = std::vector(4, KernelKind::netgen),
          .limiter = one_limit(0.5),
          .limited = {2},
          .failures = {{2, {"before"}}}};
}

TEST(WithFoldedSubdivided, ChangesTheFoldedOnesAloneAndKeepsWhatTheirTriesSaid)
{
  FilledPieces filled;
  filled.folded = {{.subdomain = 1, .was_limited = true}, {.subdomain = 3}};
  filled.failures = {{0, {"of a piece that was made"}}, {1, {"a", "b"}}, {3, {"c"}}};
  const Plan plan = with_folded_subdivided(plan_of_four(), filled);
  EXPECT_EQ(plan.kernels, (std::vector{KernelKind::netgen, KernelKind::subdivide,
                                       KernelKind::netgen, KernelKind::subdivide}));
  EXPECT_EQ(plan.limiter, one_limit(0.5));
  EXPECT_EQ(plan.limited, (std::vector<LocalIndex>{1, 2}));
  ASSERT_EQ(plan.failures.size(), 3U);
  EXPECT_EQ(plan.failures[1].subdomain, 1);
  EXPECT_EQ(plan.failures[1].messages, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(plan.failures[2].subdomain, 3);
}

TEST(LeadToTheSameFills, KernelsAndLimitsDecideAndTextsDoNot)
{
  const Plan plan = plan_of_four();
  Plan said_more = plan;
  said_more.failures.push_back({1, {"once more"}});
  said_more.limited.push_back(3);
  EXPECT_TRUE(lead_to_the_same_fills(plan, said_more));

  Plan other_kernel = plan;
  other_kernel.kernels[3] = KernelKind::subdivide;
  EXPECT_FALSE(lead_to_the_same_fills(plan, other_kernel));

  Plan lower = plan;
  lower.limiter = one_limit(0.25);
  EXPECT_FALSE(lead_to_the_same_fills(plan, lower));
}

}  // namespace
}  // namespace tessera::pipeline
