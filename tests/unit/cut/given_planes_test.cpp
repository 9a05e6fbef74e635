// SPDX-License-Identifier: BSD-3-Clause
// Planes that the user gives.
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/cut/choose_planes.hpp"

#include "sample_models.hpp"

namespace tessera::cut {
namespace {

TEST(GivenPlanes, CutEveryPartThatTheyCross)
{
  const CutOptions options{.coarse_size = 0.3,
                           .given = {{{1, 0, 0}, 1.0}, {{0, 2, 0}, 2.0}, {{0, 0, 1}, 0.5}}};
  const CutChoice choice = choose_planes(testing::box(3, 2, 1), options);
  ASSERT_EQ(choice.tree.num_parts, 8);
  EXPECT_NO_THROW(choice.tree.require_sound());
  for (const CutPart& part : choice.report.parts) {
    EXPECT_TRUE(std::abs(part.volume - 0.5) < 1e-12 || std::abs(part.volume - 1.0) < 1e-12);
  }
  for (const PlaneJudgement& plane : choice.report.planes) EXPECT_TRUE(plane.is_given);
  EXPECT_EQ(choice.tree.nodes.front().plane, (Plane{{1, 0, 0}, 1.0}));
  // The normal gets length 1.
  EXPECT_EQ(choice.tree.nodes[1].plane, (Plane{{0, 1, 0}, 1.0}));
}

TEST(GivenPlanes, TheRuleAddsWhatIsMissing)
{
  for (const auto& [rule, word] : kEnumWords<PlaneRule>) {
    const CutOptions options{
        .rule = rule, .parts = 5, .coarse_size = 0.3, .given = {{{1, 0, 0}, 1.0}}};
    const CutChoice choice = choose_planes(testing::box(3, 2, 1), options);
    EXPECT_EQ(choice.tree.num_parts, 5) << word;
    LocalIndex num_given = 0;
    for (const PlaneJudgement& plane : choice.report.planes) num_given += plane.is_given ? 1 : 0;
    EXPECT_EQ(num_given, 1) << word;
  }
}

TEST(GivenPlanes, CutSolidsThatTheyMeetAndNoOthers)
{
  const CutOptions options{.coarse_size = 0.3, .given = {{{1, 0, 0}, 1.5}}};
  const CutChoice choice = choose_planes(testing::two_cubes(), options);
  EXPECT_EQ(choice.tree.num_parts, 3);
  EXPECT_EQ(choice.tree.part_solid(), (std::vector<LocalIndex>{0, 1, 1}));
}

TEST(GivenPlanes, OneThatMeetsNoSolidIsNamed)
{
  const CutOptions options{.coarse_size = 0.3, .given = {{{1, 0, 0}, 1.0}, {{0, 0, 2}, 4.0}}};
  try {
    static_cast<void>(choose_planes(testing::box(3, 2, 1), options));
    FAIL() << "the second plane is above the box";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cut plane 2"), std::string::npos) << message;
    EXPECT_NE(message.find("from 0 to 1"), std::string::npos) << message;
  }
}

TEST(GivenPlanes, OneOnAFaceMeetsNoSolid)
{
  const CutOptions options{.coarse_size = 0.3, .given = {{{1, 0, 0}, 1.0}}};
  EXPECT_THROW(static_cast<void>(choose_planes(testing::two_cubes(), options)), InputError);
}

}  // namespace
}  // namespace tessera::cut
