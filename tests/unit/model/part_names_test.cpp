// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/part_names.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::model {
namespace {

void add_square(ModelDescription& model, LocalIndex row, const Vec3& corner, const Vec3& a,
                const Vec3& b)
{
  const auto first = static_cast<LocalIndex>(model.vertex_xyz.size() / 3);
  for (const Vec3& p : {corner, corner + a, corner + a + b, corner + b}) {
    model.vertex_xyz.insert(model.vertex_xyz.end(), p.begin(), p.end());
  }
  for (const LocalIndex c : {0, 1, 2, 0, 2, 3}) model.triangle_vertices.push_back(first + c);
  model.triangle_face.insert(model.triangle_face.end(), 2, row);
}

// Some faces of two unit cubes side by side along x; the last one bends a little.
ModelDescription two_cubes()
{
  constexpr Vec3 kX{1, 0, 0};
  constexpr Vec3 kY{0, 1, 0};
  constexpr Vec3 kZ{0, 0, 1};
  ModelDescription model{
      .solids = {{"steel", 1.0}, {"copper", 1.0}},
      .faces = {{.number = 1, .name = "in_low", .colour = "#FF0000", .solids = {1}},
                {.number = 2, .name = "in_high", .solids = {1}},
                {.number = 4, .colour = "#00FF00", .solids = {1, 2}},
                {.number = 7, .colour = "#FF0000", .solids = {2}}}};
  add_square(model, 0, {0, 0, 0}, kY, kX);  // z = 0, down.
  add_square(model, 1, {0, 0, 1}, kX, kY);  // z = 1, up.
  add_square(model, 2, {1, 0, 0}, kY, kZ);  // x = 1, from the first solid into the second.
  add_square(model, 3, {2, 0, 0}, kY, kZ);  // x = 2, and a bit of another direction:
  add_square(model, 3, {2, 0, 1}, kY, Vec3{0.1, 0, 1});
  return model;
}

std::vector<LocalIndex> faces_of(const FaceCriteria& of, double scale = 1.0)
{
  std::vector<LocalIndex> numbers;
  for (const auto& face :
       find_named_parts(two_cubes(), std::vector<PartName>{{"it", of}}, scale).faces) {
    EXPECT_EQ(face.name, "it");
    numbers.push_back(face.number);
  }
  return numbers;
}

std::string error_of(const std::vector<PartName>& names)
{
  return testing::message_of<ConfigError>(
      [&] { static_cast<void>(find_named_parts(two_cubes(), names, 1.0)); });
}

using Numbers = std::vector<LocalIndex>;

TEST(FindNamedParts, EachCriterionChoosesFaces)
{
  EXPECT_EQ(faces_of({.faces = {7, 1}}), (Numbers{1, 7}));
  EXPECT_EQ(faces_of({.pattern = "in_*"}), (Numbers{1, 2}));
  EXPECT_EQ(faces_of({.pattern = "*"}), (Numbers{1, 2}));  // The others have no name.
  EXPECT_EQ(faces_of({.colour = "#ff0000"}), (Numbers{1, 7}));
  EXPECT_EQ(faces_of({.normal = {0, 0, 7}}), (Numbers{2}));
  EXPECT_EQ(faces_of({.normal = {0, 0, -1}}), (Numbers{1}));
  EXPECT_EQ(faces_of({.box_min = {0, 0, 0}, .box_max = {1, 1, 1}}), (Numbers{1, 2, 4}));
}

// A surface of CSG that two solids have a part of each.
TEST(FindNamedParts, ANumberIsNamedIfAllThatHaveItFit)
{
  ModelDescription model = two_cubes();
  model.faces[1].number = 1;
  const auto numbers_of = [&](const FaceCriteria& of) {
    return find_named_parts(model, std::vector<PartName>{{"it", of}}, 1.0).faces;
  };
  EXPECT_EQ(numbers_of({.faces = {1}}), (std::vector<NumberedName>{{1, "it"}}));
  EXPECT_EQ(numbers_of({.pattern = "in_*"}), (std::vector<NumberedName>{{1, "it"}}));
  EXPECT_EQ(numbers_of({.colour = "#FF0000"}), (std::vector<NumberedName>{{7, "it"}}));
}

TEST(FindNamedParts, ANormalIsThatOfAllTrianglesWithinTheTolerance)
{
  EXPECT_EQ(faces_of({.normal = {1, 0, 0}}), (Numbers{4}));
  EXPECT_EQ(faces_of({.normal = {1, 0, 0}, .tolerance_deg = 6.0}), (Numbers{4, 7}));
}

TEST(FindNamedParts, AllCriteriaMustHold)
{
  EXPECT_EQ(faces_of({.pattern = "in*", .colour = "#FF0000"}), (Numbers{1}));
  EXPECT_EQ(faces_of({.faces = {1, 2, 4}, .normal = {0, 0, 1}}), (Numbers{2}));
}

TEST(FindNamedParts, BoxesAreInOutputUnits)
{
  EXPECT_EQ(faces_of({.box_min = {0, 0, 0}, .box_max = {10, 10, 10}}, 10.0), (Numbers{1, 2, 4}));
  // As `tessera info` would print a box with six digits.
  EXPECT_EQ(faces_of({.box_min = {0, 0, 0}, .box_max = {0.999999, 1, 1}}), (Numbers{1, 2, 4}));
}

TEST(FindNamedParts, SolidsHaveNumbersNamesAndBoxes)
{
  const auto solids_of = [](const SolidCriteria& of) {
    const auto parts = find_named_parts(two_cubes(), std::vector<PartName>{{"it", of}}, 1.0);
    EXPECT_TRUE(parts.faces.empty());
    return parts.solids;
  };
  EXPECT_EQ(solids_of({.solids = {2}}), (std::vector<NumberedName>{{2, "it"}}));
  EXPECT_EQ(solids_of({.pattern = "?teel"}), (std::vector<NumberedName>{{1, "it"}}));
  EXPECT_EQ(solids_of({.box_min = {1, 0, 0}, .box_max = {3, 1, 3}}),
            (std::vector<NumberedName>{{2, "it"}}));
}

TEST(FindNamedParts, WhatFitsNothingSaysWhatThereIs)
{
  EXPECT_EQ(error_of({{"a", FaceCriteria{.faces = {1, 3}}}}),
            "[[geometry.name]] \"a\": faces holds 3, but the model's faces are 1-2, 4, 7");
  EXPECT_EQ(error_of({{"a", SolidCriteria{.solids = {3}}}}),
            "[[geometry.name]] \"a\": solids holds 3, but the model's solids are 1-2");
  EXPECT_EQ(error_of({{"a", FaceCriteria{.pattern = "im_low"}}}),
            "[[geometry.name]] \"a\": no face has pattern = \"im_low\"; the names in the file are "
            "\"in_low\", \"in_high\"");
  EXPECT_EQ(
      error_of({{"a", FaceCriteria{.colour = "#FF0001"}}}),
      "[[geometry.name]] \"a\": no face has colour = \"#FF0001\"; the colours in the file are "
      "\"#FF0000\", \"#00FF00\"");
  EXPECT_NE(error_of({{"a", FaceCriteria{.normal = {0, 1, 0}}}}).find("tessera info lists"),
            std::string::npos);
  EXPECT_NE(error_of({{"a", FaceCriteria{.box_min = {5, 5, 5}, .box_max = {6, 6, 6}}}})
                .find("the model lies in [0, 0, 0] to [2.1, 1, 2]"),
            std::string::npos);
}

TEST(FindNamedParts, CriteriaThatNothingHasTogetherSayWhatHasEach)
{
  EXPECT_EQ(
      error_of({{"a", FaceCriteria{.faces = {2, 4, 7}, .pattern = "in_low"}}}),
      "[[geometry.name]] \"a\": no face has all that is asked for: faces = [2, 4, 7] has face "
      "2, 4, 7, pattern = \"in_low\" has face 1");
}

TEST(FindNamedParts, TwoEntriesForOneFaceAreRefused)
{
  EXPECT_EQ(error_of({{"a", FaceCriteria{.faces = {1}}}, {"b", FaceCriteria{.pattern = "in*"}}}),
            "[[geometry.name]] \"b\": face 1 has been named \"a\" by an entry before; it can be "
            "chosen by one entry only");
}

TEST(ApplyNames, PatchesOfOneNewNameGetOneRow)
{
  mesh::CoarseMesh coarse{.patch_names = {"p", "q", "wall", "q", "r"},
                          .patch_surface = {0, 1, 2, 3, 4},
                          .material_names = {"steel", "copper"}};
  apply_names({.faces = {{2, "wall"}, {5, "wall"}}, .solids = {{2, "core"}}}, coarse);
  EXPECT_EQ(coarse.patch_names, (std::vector<std::string>{"p", "wall", "wall", "q", "wall"}));
  EXPECT_EQ(coarse.patch_row, (Numbers{0, 1, 1, 2, 1}));
  EXPECT_EQ(coarse.material_names, (std::vector<std::string>{"steel", "core"}));
}

TEST(ApplyNames, NamesThatTheFileRepeatsKeepTheirRows)
{
  mesh::CoarseMesh coarse{.patch_names = {"p", "q", "q"}, .patch_surface = {0, 1, 2}};
  apply_names({.faces = {{1, "in"}}}, coarse);
  EXPECT_EQ(coarse.patch_row, (Numbers{0, 1, 2}));
  coarse.patch_row.clear();
  apply_names({}, coarse);
  EXPECT_TRUE(coarse.patch_row.empty());
}

}  // namespace
}  // namespace tessera::model
