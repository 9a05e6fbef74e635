// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

namespace tessera::config {
namespace {

using fill::FillRegion;
using fill::KernelKind;

// Four lines: what a test adds begins on the fifth.
constexpr const char* kMinimal = "[geometry]\nfile = \"a.geo\"\n[coarse]\nmax_size = 20\n";

constexpr const char* kList =
    "tables [[fill.region]], each with material and kernel and no two with the same material";

std::vector<FillRegion> regions_of(const std::string& lines,
                                   const std::vector<std::string>& overrides = {})
{
  return parse_case(kMinimal + lines, "case.toml", overrides).fill.regions;
}

std::string error_of(const std::string& lines, const std::vector<std::string>& overrides = {})
{
  try {
    (void)regions_of(lines, overrides);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_override(const std::string& text) { return error_of("", {text}); }

TEST(FillRegions, KeepTheOrderOfTheFile)
{
  const std::vector<FillRegion> wanted{{"steel", KernelKind::subdivide},
                                       {"Öl \"2\"", KernelKind::netgen}};
  EXPECT_EQ(regions_of("[[fill.region]]\nmaterial = 'steel'\nkernel = 'subdivide'\n"
                       "[[fill.region]]\nkernel = 'netgen'\nmaterial = 'Öl \"2\"'\n"),
            wanted);
  EXPECT_EQ(regions_of("[fill]\nregion = [{material = 'steel', kernel = 'subdivide'},\n"
                       "{kernel = 'netgen', material = 'Öl \"2\"'}]\n"),
            wanted);
}

TEST(FillRegions, StandBesideTheKeysOfTheirTable)
{
  const Case loaded = parse_case(std::string(kMinimal)
                                     + "[fill]\nkernel = 'subdivide'\n[[fill.region]]\n"
                                       "material = 'a'\nkernel = 'netgen'\n[output]\nfiles = 3\n",
                                 "case.toml");
  EXPECT_EQ(loaded.fill.kernel, KernelKind::subdivide);
  EXPECT_EQ(loaded.fill.regions, (std::vector<FillRegion>{{"a", KernelKind::netgen}}));
  EXPECT_EQ(loaded.output.files, 3);
}

TEST(FillRegions, NoneIsTheDefaultAndMayBeSaid)
{
  EXPECT_TRUE(regions_of("").empty());
  EXPECT_TRUE(regions_of("[fill]\nregion = []\n").empty());
}

TEST(FillRegions, OverrideReplacesThemAll)
{
  const std::string file =
      "[[fill.region]]\nmaterial = 'a'\nkernel = 'netgen'\n"
      "[[fill.region]]\nmaterial = 'b'\nkernel = 'netgen'\n";
  EXPECT_EQ(regions_of(file, {{R"(fill.region=[{material="c",kernel="subdivide"}])"}}),
            (std::vector<FillRegion>{{"c", KernelKind::subdivide}}));
  EXPECT_TRUE(regions_of(file, {{"fill.region=[]"}}).empty());
}

TEST(FillRegionErrors, UnknownKeyNamesItsOwnLineAndTheNearestKey)
{
  EXPECT_EQ(error_of("[[fill.region]]\nmaterial = 'a'\nkernal = 'netgen'"),
            "case.toml:7: unknown key \"fill.region.kernal\"; did you mean \"fill.region.kernel\"? "
            "(configs/reference.toml lists all keys)");
  EXPECT_NE(error_of("[[fill.region]]\nmaterial = 'a'\ntimeout_s = 3")
                .find("case.toml:7: unknown key \"fill.region.timeout_s\"; did you mean "
                      "\"fill.timeout_s\"?"),
            std::string::npos);
  EXPECT_NE(error_of("[[fill.region]]\n[fill.region.material.name]\nx = 'a'")
                .find("case.toml:7: unknown key \"fill.region.material.name.x\""),
            std::string::npos);
}

TEST(FillRegionErrors, MisspeltListIsNear)
{
  EXPECT_NE(error_of("[[fill.regions]]\nmaterial = 'a'")
                .find("case.toml:5: unknown key \"fill.regions\"; did you mean \"fill.region\"?"),
            std::string::npos);
  EXPECT_NE(error_of("[[region]]\nmaterial = 'a'").find("did you mean \"fill.region\"?"),
            std::string::npos);
}

TEST(FillRegionErrors, MissingKeyNamesTheLineOfItsTable)
{
  EXPECT_EQ(
      error_of("[[fill.region]]\nmaterial = 'a'\nkernel = 'netgen'\n\n"
               "[[fill.region]]\nmaterial = 'b'"),
      "case.toml:9: no fill.region.kernel; must be one of \"netgen\", \"optimize\", \"subdivide\"");
  EXPECT_EQ(error_of("[[fill.region]]\nkernel = 'netgen'"),
            "case.toml:5: no fill.region.material; must be text in quotes, not empty");
  EXPECT_EQ(error_of("[[fill.region]]"),
            "case.toml:5: no fill.region.material; must be text in quotes, not empty");
}

TEST(FillRegionErrors, WrongValueNamesItsOwnLine)
{
  EXPECT_EQ(error_of("[[fill.region]]\nmaterial = 'a'\nkernel = 'tetgen'"),
            "case.toml:7: fill.region.kernel = \"tetgen\": must be one of \"netgen\", "
            "\"optimize\", \"subdivide\"");
  EXPECT_EQ(error_of("[[fill.region]]\nmaterial = 1\nkernel = 'netgen'"),
            "case.toml:6: fill.region.material = 1: must be text in quotes, not empty");
  EXPECT_EQ(error_of("[[fill.region]]\nmaterial = ''"),
            "case.toml:6: fill.region.material = \"\": must be text in quotes, not empty");
  EXPECT_EQ(
      error_of("[[fill.region]]\n[fill.region.material]"),
      "case.toml:6: fill.region.material = an empty table: must be text in quotes, not empty");
}

TEST(FillRegionErrors, MaterialGivenTwiceNamesBothLines)
{
  EXPECT_EQ(
      error_of("[[fill.region]]\nmaterial = 'a'\nkernel = 'netgen'\n"
               "[[fill.region]]\nmaterial = 'a'\nkernel = 'subdivide'"),
      "case.toml:9: fill.region.material = \"a\": given twice (first at case.toml:6); must be "
      "another one in every [[fill.region]]");
}

TEST(FillRegionErrors, MaterialGivenTwiceOnOneLineNamesItOnce)
{
  EXPECT_EQ(error_of_override(
                "fill.region=[{material='a',kernel='netgen'},{material='a',kernel='netgen'}]"),
            "--set fill.region=[{material='a',kernel='netgen'},{material='a',kernel='netgen'}]: "
            "fill.region.material = \"a\": given twice; must be another one in every "
            "[[fill.region]]");
}

TEST(FillRegionErrors, WhatIsNoListOfTablesIsRefused)
{
  EXPECT_EQ(error_of("[fill]\nregion = 'a'"),
            std::string("case.toml:6: fill.region = \"a\": must be ") + kList);
  EXPECT_EQ(error_of("[fill]\nregion = ['a']"),
            std::string("case.toml:6: fill.region = [\"a\"]: must be ") + kList);
  EXPECT_EQ(error_of("[fill.region]"),
            std::string("case.toml:5: fill.region = an empty table: must be ") + kList);
  EXPECT_EQ(error_of("[fill.region]\nmaterial = 'a'"),
            std::string("case.toml:6: fill.region.material stands outside of a list; fill.region "
                        "must be ")
                + kList);
}

TEST(FillRegionErrors, OverridesNameThemselves)
{
  EXPECT_EQ(error_of_override("fill.region="),
            std::string("--set fill.region=: no value after '='; must be ") + kList);
  EXPECT_EQ(error_of_override("fill.region=steel"),
            std::string("--set fill.region=steel: fill.region = \"steel\": must be ") + kList);
  EXPECT_EQ(error_of_override("fill.region.kernel=netgen"),
            std::string("--set fill.region.kernel=netgen: fill.region.kernel stands outside of a "
                        "list; fill.region must be ")
                + kList);
  EXPECT_EQ(error_of_override("fill.region=[{material='a'}]"),
            "--set fill.region=[{material='a'}]: no fill.region.kernel; must be one of \"netgen\", "
            "\"optimize\", \"subdivide\"");
  EXPECT_EQ(error_of_override("fill.region=[{material='a',kernel=1}]"),
            "--set fill.region=[{material='a',kernel=1}]: fill.region.kernel = 1: must be one of "
            "\"netgen\", \"optimize\", \"subdivide\"");
}

}  // namespace
}  // namespace tessera::config
