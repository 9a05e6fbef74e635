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

}  // namespace
}  // namespace tessera::formats
