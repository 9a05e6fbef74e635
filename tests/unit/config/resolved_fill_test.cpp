// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

namespace tessera::config {
namespace {

Case with(const std::vector<std::string>& overrides)
{
  return parse_case("geometry.file = 'a.geo'\ncoarse.max_size = 1.0", "/cases/a.toml", overrides);
}

TEST(ResolvedFill, LeavesCornersToTheKernelUnlessToldOtherwise)
{
  EXPECT_EQ(resolved_fill(with({}), false).split_corners, std::nullopt);
  EXPECT_EQ(resolved_fill(with({"fill.split_corners=auto"}), false).split_corners, std::nullopt);
  EXPECT_EQ(resolved_fill(with({"fill.split_corners=true"}), false).split_corners, true);
  EXPECT_EQ(resolved_fill(with({"fill.split_corners=false"}), false).split_corners, false);
  EXPECT_THROW((void)with({"fill.split_corners=perhaps"}), ConfigError);
}

TEST(ResolvedFill, DividesCornersForOpenFoam)
{
  for (const std::string format : {"openfoam", "openfoam-serial"}) {
    const std::string formats = "output.formats=[\"pvtu\", \"" + format + "\"]";
    EXPECT_EQ(resolved_fill(with({formats}), false).split_corners, true);
    EXPECT_EQ(resolved_fill(with({formats}), true).split_corners, false) << "only some subdomains";
    EXPECT_EQ(resolved_fill(with({formats, "fill.split_corners=false"}), false).split_corners,
              false);
  }
  EXPECT_EQ(resolved_fill(with({"output.formats=[\"pvtu\", \"msh\"]"}), false).split_corners,
            std::nullopt);
}

TEST(ResolvedFill, FillsOnAllLevelsForSecondOrder)
{
  EXPECT_EQ(resolved_fill(with({}), false).levels, 0);
  EXPECT_EQ(resolved_fill(with({"output.order=2"}), false).levels, fill::kAllLevels);
  EXPECT_EQ(resolved_fill(with({"output.order=2", "fill.levels=auto"}), false).levels,
            fill::kAllLevels);
  EXPECT_EQ(resolved_fill(with({"fill.levels=3"}), false).levels, 3);
}

TEST(ResolvedFill, IsWrittenAsItIsRead)
{
  for (const std::string value : {"\"auto\"", "true", "false"}) {
    const std::string text = to_toml(with({"fill.split_corners=" + value}));
    EXPECT_NE(text.find("split_corners = " + value), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace tessera::config
