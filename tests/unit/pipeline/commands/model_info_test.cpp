// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/model_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tessera/base/error.hpp"

#include "pipeline/drawing/model_picture.hpp"

namespace tessera::pipeline {
namespace {

// A unit tet: three faces on the planes of the axes, and the slanted one.
model::ModelDescription unit_tet()
{
  model::ModelDescription tet{.solids = {{"tet", 1.0 / 6.0}}};
  tet.edges = {{"1", "rim", 1.0, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {.number = "3"}};
  for (LocalIndex f = 0; f < 4; ++f) {
    tet.faces.push_back({.number = 2 * f + 1, .area = f < 3 ? 0.5 : 0.866, .solids = {1}});
    tet.triangle_face.push_back(f);
  }
  tet.faces[1].name = "wall";
  tet.faces[1].colour = "#FF0000";
  tet.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  tet.triangle_vertices = {0, 2, 3, 0, 3, 1, 0, 1, 2, 1, 2, 3};
  return tet;
}

TEST(ModelInfo, SumsUpWhatSolidsShare)
{
  model::ModelDescription solids = unit_tet();
  EXPECT_TRUE(touches_of(solids).empty());
  EXPECT_EQ(model_text({}, solids, false).find("share faces"), std::string::npos);
  solids.solids.push_back({"other", 1.0});
  solids.solids.push_back({.volume = 1.0});
  solids.faces[0].solids = solids.faces[3].solids = {1, 2};
  solids.faces[1].solids = {2, 3};
  const std::vector<Touch> touches = touches_of(solids);
  ASSERT_EQ(touches.size(), 2U);
  EXPECT_EQ(touches[0].solids, (std::array<LocalIndex, 2>{1, 2}));
  EXPECT_EQ(touches[0].num_faces, 2);
  EXPECT_DOUBLE_EQ(touches[0].area, 0.5 + 0.866);
  const std::string text = model_text({}, solids, false);
  EXPECT_NE(text.find("pairs of solids that share faces: 2\n"
                      "  solids 1 'tet' and 2 'other': 2 faces, area 1.366\n"
                      "  solids 2 'other' and 3: 1 faces, area 0.5\n"),
            std::string::npos)
      << text;
}

TEST(ModelInfo, SuggestsSizesOfTwoDigitsThatFallWithTheTetsWanted)
{
  for (const double volume : {1e-12, 0.3, 1.0, 5924.65, 1e15}) {
    const Extent extent{volume, 5.0 * std::cbrt(volume) * std::cbrt(volume)};
    const auto sizes = suggested_sizes(extent);
    ASSERT_EQ(sizes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(sizes[i].num_tets, i == 0 ? 2e4 : i == 1 ? 2e5 : 2e6, 0.2 * sizes[i].num_tets);
      EXPECT_LT(sizes[i].size, i == 0 ? 1e30 : sizes[i - 1].size);
    }
    const double ratio = suggested_sizes({8.0 * volume, 4.0 * extent.area})[0].size / sizes[0].size;
    EXPECT_NEAR(ratio, 2.0, 0.2);
  }
}

TEST(ModelInfo, ThinWallsNeedLargerSizesForTheSameTets)
{
  EXPECT_GT(suggested_sizes({1.0, 60.0})[0].size, 1.3 * suggested_sizes({1.0, 6.0})[0].size);
}

TEST(ModelInfo, FlatFacesHaveNormals)
{
  const auto json = nlohmann::json::parse(model_json({}, unit_tet()));
  EXPECT_EQ(json["faces"][0]["normal"], (std::vector<double>{1.0, 0.0, 0.0}));
  model::ModelDescription bent = unit_tet();
  bent.triangle_face[1] = 0;
  EXPECT_TRUE(nlohmann::json::parse(model_json({}, bent))["faces"][0]["normal"].is_null());
}

TEST(ModelInfo, TextAndJsonNameFacesByTheirNumbers)
{
  const model::ModelSource source{.file_name = "tet.step", .length_unit = "mm"};
  const std::string text = model_text(source, unit_tet(), true);
  EXPECT_NE(text.find("wall"), std::string::npos);
  EXPECT_NE(text.find("colour #FF0000"), std::string::npos);
  EXPECT_NE(text.find("edges: 2"), std::string::npos);
  EXPECT_NE(text.find("rim                  length 1 mm, box (0, 0, 0) to (1, 0, 0)"),
            std::string::npos)
      << text;
  EXPECT_LT(text.find("solids: "), text.find("faces: 4"));
  EXPECT_LT(text.find("faces: 4"), text.find("edges: 2"));
  const auto json = nlohmann::json::parse(model_json(source, unit_tet()));
  ASSERT_EQ(json["faces"].size(), 4U);
  EXPECT_EQ(json["faces"][1]["number"], 3);
  EXPECT_EQ(json["faces"][1]["name"], "wall");
  EXPECT_EQ(json["faces"][2]["box"]["high"], (std::vector<double>{1.0, 1.0, 0.0}));
  ASSERT_EQ(json["edges"].size(), 2U);
  EXPECT_EQ(json["edges"][0]["name"], "rim");
  EXPECT_EQ(json["edges"][1]["number"], "3");
  EXPECT_EQ(json["edges"][0]["box"]["high"], (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_EQ(json["solids"][0]["num_faces"], 4);
  EXPECT_EQ(json["length_unit"], "mm");
}

TEST(ModelInfo, EdgesAreOnlyCountedUnlessTheirListIsAskedFor)
{
  const std::string text = model_text({}, unit_tet(), false);
  EXPECT_NE(text.find("edges: 2 (--edges lists them)"), std::string::npos) << text;
  EXPECT_EQ(text.find("rim"), std::string::npos) << text;
  EXPECT_NE(text.find("wall"), std::string::npos) << text;
}

TEST(ModelInfo, AFaceWithoutTrianglesHasNoBox)
{
  model::ModelDescription tet = unit_tet();
  tet.faces.push_back({.number = 9, .area = 1.0, .solids = {1}});
  EXPECT_NE(model_text({}, tet, false).find("not drawn"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(model_json({}, tet))["faces"][4]["box"].is_null());
}

TEST(ModelPicture, ShowsEveryFaceOfATetFromOneOfTwoSides)
{
  const Picture picture = draw_model(unit_tet());
  ASSERT_EQ(picture.pixels.size(),
            static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const auto largest = *std::ranges::max_element(picture.pixels);
  EXPECT_LT(largest, picture.palette.size());
  const std::set<std::uint8_t> colours(picture.pixels.begin(), picture.pixels.end());
  EXPECT_GE(colours.size(), 2U + 4U);  // White, black, and a shade for each face.
}

TEST(ModelDescription, RefusesWhatDoesNotFit)
{
  EXPECT_NO_THROW(unit_tet().require_sound());
  const auto refuses = [](auto damage) {
    model::ModelDescription tet = unit_tet();
    damage(tet);
    EXPECT_THROW(tet.require_sound(), InputError);
  };
  refuses([](auto& tet) { tet.triangle_vertices.back() = 4; });
  refuses([](auto& tet) { tet.triangle_face.back() = -1; });
  refuses([](auto& tet) { tet.triangle_face.pop_back(); });
  refuses([](auto& tet) { tet.vertex_xyz.back() = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](auto& tet) { tet.faces.front().solids = {2}; });
}

}  // namespace
}  // namespace tessera::pipeline
