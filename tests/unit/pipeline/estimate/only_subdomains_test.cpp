// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/only_subdomains.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

// Empty if the case alone does not rule it out.
std::string refusal(const config::Case& given)
{
  try {
    require_only_subdomains_possible(given);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

std::string refusal(const std::vector<LocalIndex>& only, const std::vector<KernelKind>& kernels)
{
  try {
    static_cast<void>(ranges_of_only(only, kernels));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

bool names_the_kernels(const std::string& message)
{
  return message.find("needs fill.kernel = \"subdivide\"") != std::string::npos;
}

TEST(OnlySubdomains, ACaseWithoutSubdivisionIsRefusedBeforehand)
{
  config::Case given;
  EXPECT_TRUE(names_the_kernels(refusal(given)));
  given.fill.regions = {{"core", KernelKind::netgen}};
  EXPECT_TRUE(names_the_kernels(refusal(given)));
}

TEST(OnlySubdomains, OnlyTheModelTellsWhetherRegionsAreAllThereIs)
{
  config::Case given;
  given.fill.regions = {{"core", KernelKind::subdivide}};
  EXPECT_EQ(refusal(given), "");
  given.fill.kernel = KernelKind::subdivide;
  EXPECT_EQ(refusal(given), "");
}

TEST(OnlySubdomains, FilesOfSeveralSubdomainsAreRefused)
{
  config::Case given;
  given.fill.kernel = KernelKind::subdivide;
  given.output.files = 2;
  EXPECT_NE(refusal(given).find("excludes output.files"), std::string::npos);
  given.output.files = 0;
  given.output.parts = 2;
  EXPECT_NE(refusal(given).find("output.parts"), std::string::npos);
}

TEST(OnlySubdomains, EachIsAFileUnderItsOwnNumber)
{
  const auto ranges = ranges_of_only({1, 3}, std::vector(4, KernelKind::subdivide));
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[1].number, 3);
  EXPECT_EQ(ranges[1].first, 3);
  EXPECT_EQ(ranges[1].last, 4);
}

TEST(OnlySubdomains, OneThatIsNotThereOrNotSubdividedIsRefused)
{
  EXPECT_NE(refusal({1, 4}, std::vector(4, KernelKind::subdivide))
                .find("no subdomain 4, the last one is 3"),
            std::string::npos);
  // Subdomain 1 alone would do, but ids need the counts of all.
  EXPECT_TRUE(names_the_kernels(refusal({1}, {KernelKind::netgen, KernelKind::subdivide})));
}

}  // namespace
}  // namespace tessera::pipeline
