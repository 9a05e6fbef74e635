// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/name_patterns.hpp"

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera {
namespace {

using Names = std::vector<std::string>;

TEST(MatchesPattern, AsAShellDoes)
{
  EXPECT_TRUE(matches_pattern("*", ""));
  EXPECT_TRUE(matches_pattern("*", "a/b"));
  EXPECT_TRUE(matches_pattern("in*t", "inlet_at_left"));
  EXPECT_TRUE(matches_pattern("in?et", "inlet"));
  EXPECT_TRUE(matches_pattern("face_[13]", "face_3"));
  EXPECT_FALSE(matches_pattern("face_[13]", "face_2"));
  EXPECT_FALSE(matches_pattern("in?et", "inet"));
  EXPECT_FALSE(matches_pattern("inlet", "inlet_2"));
  EXPECT_FALSE(matches_pattern("", "inlet"));
}

TEST(MatchesPattern, ANameThatLooksLikeAPattern)
{
  EXPECT_TRUE(matches_pattern("face [1]", "face [1]"));
  EXPECT_TRUE(matches_pattern("what?", "what?"));
  EXPECT_TRUE(matches_pattern("[", "["));
}

TEST(NearestFirst, QuotesEachNameOnce)
{
  EXPECT_EQ(nearest_first("inlt", Names{"wall", "inlet", "wall", "outlet"}),
            R"("inlet", "wall", "outlet")");
  EXPECT_EQ(nearest_first("inlt", Names{}), "");
}

TEST(NearestFirst, SaysHowManyMoreThereAre)
{
  Names names;
  for (int i = 10; i < 24; ++i) names.push_back("face_" + std::to_string(i));
  const std::string text = nearest_first("face_23", names);
  EXPECT_TRUE(text.starts_with(R"("face_23", ")")) << text;
  EXPECT_TRUE(text.ends_with(" and 2 more")) << text;
  names.resize(12);
  EXPECT_EQ(nearest_first("face_23", names).find("more"), std::string::npos);
}

TEST(MatchingNames, AreMarkedOneByOne)
{
  EXPECT_EQ(matching_names("patch", "in*", Names{"in", "out", "inner"}),
            (std::vector<bool>{true, false, true}));
}

TEST(MatchingNames, AreRefusedIfThereIsNone)
{
  const std::string message = testing::message_of<ConfigError>([] {
    (void)matching_names("material", "stee", Names{"air", "steel"});
  });
  EXPECT_EQ(message, R"(material = "stee": the model has no such material; it has "steel", "air")");
}

TEST(MatchingSolids, HaveTheNumberOrTheName)
{
  const Names names{"water", "wall", "wall", "7"};
  EXPECT_EQ(matching_solids("wall", names), (std::vector<LocalIndex>{2, 3}));
  EXPECT_EQ(matching_solids("1", names), (std::vector<LocalIndex>{1}));
  EXPECT_EQ(matching_solids("7", names), (std::vector<LocalIndex>{4}));
  EXPECT_EQ(matching_solids("w*", names), (std::vector<LocalIndex>{1, 2, 3}));
  const std::string message =
      testing::message_of<ConfigError>([&] { (void)matching_solids("5", names); });
  EXPECT_TRUE(message.ends_with("numbered from 1 to 4")) << message;
}

}  // namespace
}  // namespace tessera
