// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

using sizing::SizeRegion;

// Two lines: what a test adds begins on the third.
constexpr const char* kMinimal = "geometry.file = 'a.geo'\nsize.target = 1\n";

Case parsed(const std::string& lines, const std::vector<std::string>& overrides = {})
{
  return parse_case(kMinimal + lines, "/cases/case.toml", overrides);
}

std::string error_of(const std::string& lines, const std::vector<std::string>& overrides = {})
{
  return testing::message_of<ConfigError>([&] { (void)parsed(lines, overrides); });
}

std::string region_error(const std::string& keys) { return error_of("[[size.region]]\n" + keys); }

TEST(SizeKeys, ReachTheirOwnOptions)
{
  const Case loaded = parsed(
      "size.min = 0.5\nsize.max = 3\nsize.grading = 0.1\nsize.field = '../f.vtu'\n"
      "size.field_array = 'h'\n");
  EXPECT_EQ(loaded.size.target, 1.0);
  EXPECT_EQ(loaded.size.min, 0.5);
  EXPECT_EQ(loaded.size.max, 3.0);
  EXPECT_EQ(loaded.size.grading, 0.1);
  EXPECT_EQ(loaded.size.field, "/f.vtu");
  EXPECT_EQ(loaded.size.field_array, "h");
  EXPECT_TRUE(sizing::is_graded(loaded.size));
}

TEST(SizeKeys, OneSizeEverywhereIsTheDefault)
{
  const Case loaded = parsed("");
  EXPECT_FALSE(sizing::is_graded(loaded.size));
  EXPECT_TRUE(loaded.size.field.empty());
  EXPECT_EQ(loaded.size.field_array, "size");
  EXPECT_EQ(loaded.size.grading, 0.3);
}

TEST(SizeKeys, FieldIsRelativeToTheCaseFileAndAbsoluteOnesStay)
{
  EXPECT_EQ(parsed("", {{"size.field=a b.vti"}}).size.field, "/cases/a b.vti");
  EXPECT_EQ(parsed("", {{"size.field=/x/a.pvtu"}}).size.field, "/x/a.pvtu");
}

TEST(SizeKeys, RefuseWhatIsOutOfRange)
{
  for (const char* line : {"size.max = 0", "size.max = -1", "size.grading = 0",
                           "size.grading = 1.5", "size.max = nan"}) {
    EXPECT_NE(error_of(line).find("case.toml:3: size."), std::string::npos) << line;
    EXPECT_NE(error_of(line).find("must be a number > 0"), std::string::npos) << line;
  }
  EXPECT_NE(error_of("size.min = 2\nsize.max = 1").find("size.min = 2.0 is above size.max = 1.0"),
            std::string::npos);
  EXPECT_EQ(error_of("size.min = 2\nsize.max = 2"), "");
  EXPECT_EQ(error_of("size.min = 0"), "") << "nothing is merged";
  EXPECT_NE(error_of("size.min = -1").find("must be a number >= 0"), std::string::npos);
}

TEST(SizeKeys, ARegionOrAFieldIsNoSizeOfAllElse)
{
  for (const char* line : {"size.field = 'f.vtu'", "[[size.region]]\nsize = 1\npatch = 'a'"}) {
    const std::string text = std::string("geometry.file = 'a.geo'\n") + line + "\n";
    EXPECT_NE(testing::message_of<ConfigError>([&] {
                (void)parse_case(text, "case.toml");
              }).find("give either size.target or coarse.max_size"),
              std::string::npos);
  }
}

TEST(SizeRegions, HaveAnyShapeInTheOrderOfTheFile)
{
  const std::vector<SizeRegion> regions = parsed(R"(
[[size.region]]
box = { min = [0, -1, 2.5], max = [1, 1, 3] }
size = 0.1
growth = 0.5
[[size.region]]
size = 0.2
ball.centre = [1, 2, 3]
ball.radius = 4
[[size.region]]
cylinder = { start = [0, 0, 0], end = [0, 0, 1], radius = 2 }
size = 0.3
[[size.region]]
size = 0.4
[size.region.halfspace]
point = [0, 0, 1]
normal = [0, 0, -2]
[[size.region]]
patch = "in*"
size = 0.5
[[size.region]]
size = 0.6
material = "steel"
[[size.region]]
curve = "7"
size = 0.7
)")
                                              .size.regions;
  const std::vector<SizeRegion> wanted{
      {sizing::Box{{0.0, -1.0, 2.5}, {1.0, 1.0, 3.0}}, 0.1, 0.5},
      {sizing::Ball{{1.0, 2.0, 3.0}, 4.0}, 0.2, 0.0},
      {sizing::Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 2.0}, 0.3, 0.0},
      {sizing::HalfSpace{{0.0, 0.0, 1.0}, {0.0, 0.0, -2.0}}, 0.4, 0.0},
      {sizing::PatchPattern{"in*"}, 0.5, 0.0},
      {sizing::MaterialPattern{"steel"}, 0.6, 0.0},
      {sizing::CurvePattern{"7"}, 0.7, 0.0}};
  EXPECT_EQ(regions, wanted);
}

TEST(SizeRegions, MayBeEqual)
{
  const std::string region = "[[size.region]]\npatch = 'a'\nsize = 1\n";
  EXPECT_EQ(parsed(region + region).size.regions.size(), 2U);
}

TEST(SizeRegions, OverrideReplacesThemAll)
{
  const Case loaded =
      parsed("[[size.region]]\npatch = 'a'\nsize = 1\n",
             {{R"(size.region=[{size=2,ball={centre=[0,0,0],radius=1}}, {size=3,patch="b"}])"}});
  EXPECT_EQ(loaded.size.regions,
            (std::vector<SizeRegion>{{sizing::Ball{{0.0, 0.0, 0.0}, 1.0}, 2.0, 0.0},
                                     {sizing::PatchPattern{"b"}, 3.0, 0.0}}));
  EXPECT_TRUE(parsed("[[size.region]]\npatch = 'a'\nsize = 1\n", {{"size.region=[]"}})
                  .size.regions.empty());
}

TEST(SizeRegionErrors, MissingKeysNameTheLineOfTheirTable)
{
  EXPECT_EQ(region_error("patch = 'a'"),
            "/cases/case.toml:3: no size.region.size; must be a number > 0 and <= 1e+30");
  EXPECT_EQ(region_error("size = 1\nbox.min = [0, 0, 0]"),
            "/cases/case.toml:3: no size.region.box.max; must be a list of three numbers");
  EXPECT_EQ(
      region_error("size = 1"),
      "/cases/case.toml:3: [[size.region]] has none of box, ball, cylinder, halfspace, patch, "
      "material, curve; must have one of them");
}

TEST(SizeRegionErrors, TwoShapesNameBoth)
{
  EXPECT_EQ(region_error("size = 1\npatch = 'a'\nball.radius = 2"),
            "/cases/case.toml:6: size.region.ball.radius stands beside size.region.patch "
            "(/cases/case.toml:5); must be one of box, ball, cylinder, halfspace, patch, material, "
            "curve in every [[size.region]]");
}

TEST(SizeRegionErrors, WrongValuesNameTheirOwnLine)
{
  for (const char* value : {"1", "[1, 2]", "[1, 2, 3, 4]", "[1, 2, 'x']", "[1, 2, nan]",
                            "[1, 2, 1e300]", "'a'", "[[1, 2, 3]]"}) {
    const std::string message =
        region_error("size = 1\nball.radius = 1\nball.centre = " + std::string(value));
    EXPECT_TRUE(message.starts_with("/cases/case.toml:6: size.region.ball.centre = ")) << message;
    EXPECT_TRUE(message.ends_with("must be a list of three numbers")) << message;
  }
  EXPECT_NE(
      region_error("size = 0\npatch = 'a'").find("case.toml:4: size.region.size = 0: must be"),
      std::string::npos);
  EXPECT_NE(region_error("size = 1\npatch = ''").find("case.toml:5: size.region.patch = \"\""),
            std::string::npos);
  EXPECT_NE(region_error("size = 1\npatch = 'a'\ngrowth = 2")
                .find("case.toml:6: size.region.growth = 2: must be a number > 0 and <= 1"),
            std::string::npos);
}

TEST(SizeRegionErrors, ShapesWithoutSense)
{
  EXPECT_EQ(region_error("size = 1\nbox = { min = [0, 0, 2], max = [1, 1, 1] }"),
            "/cases/case.toml:3: [[size.region]]: box.min must not be above box.max");
  EXPECT_NE(region_error("size = 1\ncylinder = { start = [1, 2, 3], end = [1, 2, 3], radius = 1 }")
                .find("cylinder.start and cylinder.end must differ"),
            std::string::npos);
  EXPECT_NE(region_error("size = 1\nhalfspace = { point = [1, 2, 3], normal = [0, 0, 0] }")
                .find("halfspace.normal must not be zero"),
            std::string::npos);
}

TEST(SizeRegionErrors, UnknownKeysNameTheNearest)
{
  EXPECT_NE(region_error("size = 1\nball.center = [0, 0, 0]")
                .find("did you mean \"size.region.ball.centre\"?"),
            std::string::npos);
  EXPECT_NE(error_of("[size.region]\nsize = 1\nbox.min = [0, 0, 0]")
                .find("size.region.size stands outside of a list; size.region must be tables "
                      "[[size.region]], each with size and one of box"),
            std::string::npos);
  EXPECT_NE(error_of("", {"size.region.ball.radius=1"}).find("stands outside of a list"),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::config
