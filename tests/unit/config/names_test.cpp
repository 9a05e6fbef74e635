// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

using model::FaceCriteria;
using model::SolidCriteria;

// Two lines: what a test adds begins on the third.
constexpr const char* kMinimal = "geometry.file = 'a.geo'\nsize.target = 1\n";

Case parsed(const std::string& lines) { return parse_case(kMinimal + lines, "/cases/case.toml"); }

std::string error_of(const std::string& keys)
{
  return testing::message_of<ConfigError>(
      [&] { (void)parsed("[[geometry.name]]\nname = 'in'\n" + keys); });
}

constexpr const char* kNames = R"(
[[geometry.name]]
name = "inlet"
patch = { faces = [3, 1], pattern = "in*", colour = "#FF0000" }
[[geometry.name]]
name = "top"
patch.normal = [0, 0, 1]
patch.tolerance_deg = 10
patch.box = { min = [0, 0, 0], max = [1, 1, 1] }
[[geometry.name]]
name = "core"
material = { solids = [2], pattern = "c*", box = { min = [0, 0, 0], max = [1, 1, 1] } }
)";

TEST(GeometryNames, AreOfFacesOrSolids)
{
  const std::vector<model::PartName> wanted{
      {"inlet", FaceCriteria{.faces = {3, 1}, .pattern = "in*", .colour = "#FF0000"}},
      {"top",
       FaceCriteria{
           .normal = {0, 0, 1}, .tolerance_deg = 10.0, .box_min = {0, 0, 0}, .box_max = {1, 1, 1}}},
      {"core",
       SolidCriteria{.solids = {2}, .pattern = "c*", .box_min = {0, 0, 0}, .box_max = {1, 1, 1}}}};
  EXPECT_EQ(parsed(kNames).geometry.names, wanted);
}

TEST(GeometryNames, SurviveBeingWrittenOut)
{
  const Case loaded = parsed(kNames);
  EXPECT_EQ(parse_case(to_toml(loaded), "other/case.toml"), loaded);
}

TEST(GeometryNames, RefuseTwoKindsAndNone)
{
  EXPECT_NE(error_of("patch.faces = [1]\nmaterial.solids = [1]").find("must be one of patch"),
            std::string::npos);
  EXPECT_NE(error_of("").find("has none of patch, material"), std::string::npos);
  EXPECT_NE(error_of("patch.faces = []").find("geometry.name.patch.faces = []: must be a list of"),
            std::string::npos);
}

TEST(GeometryNames, RefuseValuesWithoutSense)
{
  for (const char* value : {"[0]", "[1, 1]", "[1.5]", "['a']", "3", "[99999999999]"}) {
    EXPECT_NE(error_of(std::string("patch.faces = ") + value).find("whole numbers from 1"),
              std::string::npos)
        << value;
  }
  EXPECT_NE(error_of("patch.colour = 'red'").find("#RRGGBB"), std::string::npos);
  EXPECT_NE(error_of("patch.normal = [0, 0, 0]").find("must not be zero"), std::string::npos);
  EXPECT_NE(error_of("patch.tolerance_deg = 3").find("needs one of faces"), std::string::npos);
  EXPECT_NE(error_of("patch.tolerance_deg = 3\npatch.faces = [1]").find("is of a patch.normal"),
            std::string::npos);
  EXPECT_NE(error_of("patch.box.min = [0, 0, 0]").find("both box.min and box.max"),
            std::string::npos);
  EXPECT_NE(error_of("material.box = { min = [0, 0, 2], max = [1, 1, 1] }").find("not be above"),
            std::string::npos);
  EXPECT_NE(error_of("patch.color = '#FF0000'").find("did you mean \"geometry.name.patch.colour\""),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::config
