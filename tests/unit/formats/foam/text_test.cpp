// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/text.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::formats {
namespace {

using Names = std::vector<std::string>;

TEST(FoamWords, WordsStayAsTheyAre)
{
  const Names names{"inlet", "Outlet_2", "_wall.left-1"};
  EXPECT_EQ(foam_words(names), names);
}

TEST(FoamWords, AllElseBecomesAWord)
{
  EXPECT_EQ(foam_words({"front wall", "a/b", "say \"x\";", "{c}", "2nd", "", "-", "öl"}),
            (Names{"front_wall", "a_b", "say__x__", "_c_", "_2nd", "_", "_-", "__l"}));
}

TEST(FoamWords, NoTwoAreEqual)
{
  EXPECT_EQ(foam_words({"a b", "a/b", "a_b_2", "a_b"}),
            (Names{"a_b", "a_b_2", "a_b_2_2", "a_b_3"}));
}

TEST(FoamWords, NoneIsThatOfAPatchBetweenProcessors)
{
  EXPECT_EQ(foam_words({"procBoundary0to1"}), Names{"_procBoundary0to1"});
}

TEST(FoamLists, AnEmptyOneIsItsLengthAlone)
{
  EXPECT_EQ(foam_labels({}), "0");
  const std::vector<std::int32_t> one{7};
  EXPECT_EQ(foam_labels(one), std::string("1\n(\x07\0\0\0)", 8));
}

// The lines of `boundary` on the transform of a periodic patch.
std::string transform_of(const Affine& there)
{
  const std::string text =
      foam_boundary({{.name = "a", .num_faces = 2, .cyclic = FoamCyclic{"b", there}}});
  EXPECT_NE(text.find("type cyclic;"), std::string::npos) << text;
  const std::string before = "neighbourPatch b;\n";
  const auto begin = text.find(before) + before.size();
  return text.substr(begin, text.find('}', begin) - begin);
}

TEST(FoamBoundary, AShiftIsTranslational)
{
  EXPECT_EQ(transform_of({.shift = {1.0, 0.0, -0.5}}),
            "    transform translational;\n    separationVector (1 0 -0.5);\n");
}

TEST(FoamBoundary, ATurnHasAnAxisAndACentre)
{
  // A quarter, about (1, 2, z).
  const Affine quarter{.rows = {{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}},
                       .shift = {3.0, 1.0, 0.0}};
  EXPECT_EQ(quarter({1.0, 2.0, 5.0}), (Vec3{1.0, 2.0, 5.0}));
  EXPECT_EQ(transform_of(quarter),
            "    transform rotational;\n    rotationAxis (0 0 1);\n    rotationCentre (1 2 0);\n");
}

// Both sides of half a wheel have one normal, so OpenFOAM would not find it from the faces.
TEST(FoamBoundary, HalfATurnHasThemToo)
{
  const Affine half{.rows = {{{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}}},
                    .shift = {2.0, -4.0, 0.0}};
  EXPECT_EQ(transform_of(half),
            "    transform rotational;\n    rotationAxis (0 0 1);\n    rotationCentre (1 -2 0);\n");
}

TEST(FoamBoundary, AScrewIsLeftToOpenfoam)
{
  const Affine screw{.rows = {{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}},
                     .shift = {0.0, 0.0, 1.0}};
  EXPECT_EQ(transform_of(screw), "    transform unknown;\n");
}

TEST(FoamBoundary, PartnersInAnotherPartAreThroughTheirPatch)
{
  const std::string text = foam_boundary(
      {{.name = "procBoundary0to2througha", .processor = 0, .other_processor = 2, .through = "a"}});
  for (const char* const line :
       {"type processorCyclic;", "myProcNo 0;", "neighbProcNo 2;", "referPatch a;"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in " << text;
}

}  // namespace
}  // namespace tessera::formats
