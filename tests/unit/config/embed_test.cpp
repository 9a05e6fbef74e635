// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

constexpr const char* kDisk =
    "[[embed]]\nname = 'sheet'\ndisk = { centre = [1, 2, 3], normal = [0, 0, 2], radius = 0.5 }\n";
constexpr const char* kWell =
    "[[embed]]\nname = 'well'\npolyline = [[0, 0, 0], [1, 0, 0], [1, 1, 1.0]]\n";
constexpr const char* kFault =
    "[[embed]]\nname = 'fault'\npolygon = [[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 1.0]]\n";

Case parsed(const std::string& lines, const std::string& model = "a.step")
{
  return parse_case("geometry.file = '" + model + "'\nsize.target = 1\n" + lines,
                    "/cases/case.toml", {});
}

std::string error_of(const std::string& lines, const std::string& model = "a.step")
{
  return testing::message_of<ConfigError>([&] { (void)parsed(lines, model); });
}

TEST(Embed, HasPolygonsAndDisks)
{
  const Case loaded = parsed(std::string(kDisk) + kFault);
  const model::AssemblyOptions expected{
      .embedded = {{"sheet", model::Disk{.centre = {1, 2, 3}, .normal = {0, 0, 2}, .radius = 0.5}},
                   {"fault", model::Polygon{{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}}}}};
  EXPECT_EQ(loaded.geometry.assembly, expected);
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
  EXPECT_EQ(parsed("geometry.loose_faces = 'drop'\n").geometry.assembly.loose_faces,
            model::LooseParts::drop);
}

TEST(Embed, HasPolylines)
{
  const Case loaded = parsed(std::string("geometry.loose_curves = 'embed'\n") + kWell);
  const model::AssemblyOptions expected{
      .loose_curves = model::LooseParts::embed,
      .embedded = {{"well", model::Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}}}}};
  EXPECT_EQ(loaded.geometry.assembly, expected);
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
  EXPECT_NE(
      error_of("[[embed]]\nname = 'a'\npolyline = [[0, 0, 0.0]]\n").find("two points or more"),
      std::string::npos);
  EXPECT_NE(error_of("[[embed]]\nname = 'a'\npolyline = [[0, 1, 2.0], [0, 1, 2]]\n")
                .find("has the point [0, 1, 2] twice in turn"),
            std::string::npos);
  const std::string layer = "[[layer]]\npatch = '*'\nfirst = 0.1\ncount = 2\n";
  EXPECT_NE(error_of(kWell + layer).find("[[embed]] \"well\" with a polyline excludes [[layer]]"),
            std::string::npos);
}

TEST(Embed, ScalesWithTheModel)
{
  const auto scaled = parsed(std::string(kDisk) + kFault + kWell).geometry.assembly.scaled(0.5);
  EXPECT_EQ(std::get<model::Polyline>(scaled.embedded[2].shape).points[2], (Vec3{0.5, 0.5, 0.5}));
  const auto& disk = std::get<model::Disk>(scaled.embedded[0].shape);
  EXPECT_EQ(disk.centre, (Vec3{0.5, 1.0, 1.5}));
  EXPECT_EQ(disk.normal, (Vec3{0, 0, 2}));
  EXPECT_EQ(disk.radius, 0.25);
  EXPECT_EQ(std::get<model::Polygon>(scaled.embedded[1].shape).corners[2], (Vec3{0.5, 0.5, 0.5}));
  EXPECT_LT(scaled.gap, 0.0);
}

TEST(Embed, RefusesWhatIsNoPlaneFace)
{
  const auto of_corners = [](const std::string& corners) {
    return error_of("[[embed]]\nname = 'a'\npolygon = " + corners + "\n");
  };
  EXPECT_NE(of_corners("[[0, 0, 0], [1, 0, 0]]").find("three corners or more"), std::string::npos);
  EXPECT_NE(of_corners("[[0, 0, 0], [1, 0, 0], [2, 0, 0]]").find("no area"), std::string::npos);
  EXPECT_NE(of_corners("[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.1]]")
                .find("must lie in one plane; corner ["),
            std::string::npos);
  EXPECT_NE(of_corners("[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0]]").find("equal corners"),
            std::string::npos);
  EXPECT_NE(of_corners("[[0, 0], [1, 0, 0], [1, 1, 0]]").find("a list of points"),
            std::string::npos);
  EXPECT_NE(error_of("[[embed]]\nname = 'a'\ndisk = { centre = [0, 0, 0], normal = [0, 0, 0], "
                     "radius = 1 }\n")
                .find("disk.normal must not be zero"),
            std::string::npos);
  EXPECT_NE(error_of("[[embed]]\nname = 'a'\n").find("polygon"), std::string::npos);
  EXPECT_NE(error_of(std::string(kDisk) + kDisk).find("sheet"), std::string::npos);
}

TEST(Embed, IsForModelsWithSolidsAndTheirOwnSurface)
{
  EXPECT_FALSE(parsed(kDisk, "a.geo").geometry.assembly.embedded.empty());
  EXPECT_NE(error_of(kDisk, "a.stl").find("[[embed]]"), std::string::npos);
  EXPECT_NE(error_of(std::string("coarse.mesher = 'gmsh'\n") + kDisk).find("[[embed]] excludes"),
            std::string::npos);
  EXPECT_NE(
      error_of(std::string("decompose.method = 'geometry'\n") + kDisk).find("[[embed]] excludes"),
      std::string::npos);
}

}  // namespace
}  // namespace tessera::config
