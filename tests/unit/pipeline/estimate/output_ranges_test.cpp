// SPDX-License-Identifier: BSD-3-Clause
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "pipeline/run_plan.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

using Range = std::tuple<LocalIndex, LocalIndex, LocalIndex>;  // Number, first, last.

// A run of six subdomains, with as many kernels.
RunResult run_of_six(fill::KernelKind kernel = fill::KernelKind::netgen)
{
  RunResult run;
  run.decomposition.decomposition.subdomain_material.assign(6, 1);
  run.kernels.assign(6, kernel);
  return run;
}

std::vector<Range> ranges_of(const RunResult& run, const std::vector<LocalIndex>& only = {})
{
  std::vector<Range> ranges;
  for (const auto& range : output_ranges(run, {.only_subdomains = only})) {
    ranges.emplace_back(range.number, range.first, range.last);
  }
  return ranges;
}

std::string refusal_of(const RunResult& run, const std::vector<LocalIndex>& only)
{
  return testing::message_of<ConfigError>([&] { static_cast<void>(ranges_of(run, only)); });
}

TEST(OutputRanges, EverySubdomainHasItsFileUnlessAskedOtherwise)
{
  EXPECT_EQ(ranges_of(run_of_six()),
            (std::vector<Range>{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 3, 4}, {4, 4, 5}, {5, 5, 6}}));
}

TEST(OutputRanges, FewerFilesHoldAllSubdomainsInTheirOrder)
{
  RunResult run = run_of_six();
  run.resolved.output.files = 2;
  EXPECT_EQ(ranges_of(run), (std::vector<Range>{{0, 0, 3}, {1, 3, 6}}));
}

TEST(OutputRanges, PartsComeBeforeTheNumberOfFiles)
{
  RunResult run = run_of_six();
  run.resolved.output.files = 2;
  run.decomposition.decomposition.part_offsets = {0, 1, 4, 6};
  EXPECT_EQ(ranges_of(run), (std::vector<Range>{{0, 0, 1}, {1, 1, 4}, {2, 4, 6}}));
}

TEST(OutputRanges, SubdomainsThatAreAskedForKeepTheirNumbers)
{
  RunResult run = run_of_six(fill::KernelKind::subdivide);
  run.decomposition.decomposition.part_offsets = {0, 3, 6};
  EXPECT_EQ(ranges_of(run, {1, 5}), (std::vector<Range>{{1, 1, 2}, {5, 5, 6}}));
}

TEST(OutputRanges, SomeSubdomainsNeedCountsThatAreKnown)
{
  RunResult run = run_of_six(fill::KernelKind::subdivide);
  run.kernels[4] = fill::KernelKind::netgen;
  EXPECT_NE(refusal_of(run, {1}).find("--only-subdomains needs fill.kernel"), std::string::npos);
}

TEST(OutputRanges, ASubdomainThatIsNotThereIsNamed)
{
  const RunResult run = run_of_six(fill::KernelKind::subdivide);
  EXPECT_EQ(refusal_of(run, {1, 5}), "");
  EXPECT_NE(refusal_of(run, {1, 6}).find("no subdomain 6, the last one is 5"), std::string::npos);
}

}  // namespace
}  // namespace tessera::pipeline
