// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/cut/cut_tree.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::cut {
namespace {

// Two solids: the first in three parts, at x = 1 and, above that, at y = 2; the second whole.
CutTree sample_tree()
{
  CutTree tree{.solid_root = {0, 3}, .nodes = {}, .num_parts = 4};
  tree.nodes = {{.plane = {{1, 0, 0}, 1.0}, .below = 1, .above = 2},
                {.part = 0},
                {.plane = {{0, 1, 0}, 2.0}, .below = 4, .above = 5},
                {.part = 3},
                {.part = 1},
                {.part = 2}};
  return tree;
}

TEST(CutTree, FindsThePartOfAPoint)
{
  const CutTree tree = sample_tree();
  EXPECT_NO_THROW(tree.require_sound());
  EXPECT_EQ(tree.part_of(0, {0.5, 9.0, 0.0}), 0);
  EXPECT_EQ(tree.part_of(0, {1.5, 1.0, 0.0}), 1);
  EXPECT_EQ(tree.part_of(0, {1.5, 3.0, 0.0}), 2);
  EXPECT_EQ(tree.part_of(1, {0.5, 9.0, 0.0}), 3);
}

TEST(CutTree, APointOnAPlaneIsAboveIt) { EXPECT_EQ(sample_tree().part_of(0, {1.0, 2.0, 0.0}), 2); }

TEST(CutTree, KnowsTheSolidOfEachPart)
{
  EXPECT_EQ(sample_tree().part_solid(), (std::vector<LocalIndex>{0, 0, 0, 1}));
}

TEST(CutTree, RefusesWhatIsNoTree)
{
  const auto breaks = [](const auto& damage) {
    CutTree tree = sample_tree();
    damage(tree);
    EXPECT_THROW(tree.require_sound(), InputError);
  };
  breaks([](CutTree& tree) { tree.nodes[2].above = 6; });
  breaks([](CutTree& tree) { tree.nodes[2].above = -1; });
  breaks([](CutTree& tree) { tree.nodes[2].above = 1; });
  breaks([](CutTree& tree) { tree.nodes[2].above = 4; });
  breaks([](CutTree& tree) { tree.nodes[1].part = 1; });
  breaks([](CutTree& tree) { tree.nodes[1].below = 2; });
  breaks([](CutTree& tree) { tree.nodes[0].plane.normal = {1, 1, 0}; });
  breaks([](CutTree& tree) { tree.nodes.emplace_back(); });
  breaks([](CutTree& tree) { tree.solid_root[1] = 9; });
  breaks([](CutTree& tree) { tree.num_parts = 5; });
}

}  // namespace
}  // namespace tessera::cut
