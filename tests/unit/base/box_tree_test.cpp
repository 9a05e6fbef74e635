// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box_tree.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_points.hpp"

namespace tessera {
namespace {

using Items = std::vector<LocalIndex>;

constexpr Box kAll{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};

// Boxes at random places, every tenth of them ten times as large.
std::vector<Box> random_boxes(int count)
{
  const std::vector<double> xyz = testing::points_in_cube(count);
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    const double size = i % 10 == 0 ? 0.5 : 0.05;
    const Vec3 low = point_at(std::span(xyz), i);
    boxes.push_back({low, low + Vec3{size, size, size}});
  }
  return boxes;
}

Items touching(const BoxTree& tree, const Box& asked)
{
  Items found;
  tree.visit([&](const Box& box) { return box.touches(asked); },
             [&](LocalIndex item) { found.push_back(item); });
  std::ranges::sort(found);
  return found;
}

// As the tree is meant to find them, by looking at all.
void expect_finds_all(const BoxTree& tree, const std::vector<Box>& boxes)
{
  std::size_t num_found = 0;
  for (const Box& asked : boxes) {
    Items expected;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].touches(asked)) expected.push_back(static_cast<LocalIndex>(i));
    }
    num_found += expected.size();
    ASSERT_EQ(touching(tree, asked), expected);
  }
  EXPECT_GT(num_found, boxes.size());  // They touch more than themselves.
}

TEST(BoxTree, FindsNothingWithoutBoxes)
{
  EXPECT_EQ(touching(BoxTree({}), kAll), Items());
  EXPECT_EQ(touching(BoxTree(std::vector<Box>(9)), kAll), Items());
}

TEST(BoxTree, FindsWhatTouches)
{
  const std::vector<Box> boxes = random_boxes(500);
  expect_finds_all(BoxTree(boxes), boxes);
}

// All middles are one: there is nothing to halve by.
TEST(BoxTree, FindsBoxesAtOnePlace)
{
  const std::vector<Box> boxes(100, Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  expect_finds_all(BoxTree(boxes), boxes);
}

TEST(BoxTree, FollowsBoxesThatChange)
{
  std::vector<Box> boxes = random_boxes(200);
  BoxTree tree(boxes);
  const std::vector<Box> places = random_boxes(900);
  for (std::size_t i = 0; i < places.size(); ++i) {
    boxes[(7 * i) % boxes.size()] = places[i];
    tree.change(static_cast<LocalIndex>((7 * i) % boxes.size()), places[i]);
    if (i % 100 == 99) expect_finds_all(tree, boxes);
  }
  EXPECT_EQ(tree.box(0).low, boxes[0].low);
}

TEST(BoxTree, TakesOutAnEmptyBoxAndPutsItBack)
{
  std::vector<Box> boxes = random_boxes(200);
  BoxTree tree(boxes);
  tree.change(3, {});
  Items found = touching(tree, kAll);
  EXPECT_EQ(found.size(), 199U);
  EXPECT_FALSE(std::ranges::binary_search(found, 3));
  tree.change(3, boxes[3]);
  expect_finds_all(tree, boxes);
}

// Far more beside one item than a leaf has room for, and at other places than it.
TEST(BoxTree, FindsWhatWasAddedBesideOneItem)
{
  std::vector<Box> boxes = random_boxes(20);
  BoxTree tree(boxes);
  for (const Box& box : random_boxes(300)) {
    tree.add(box, 0);
    boxes.push_back(box);
  }
  expect_finds_all(tree, boxes);
}

TEST(BoxTree, TakesAnItemWhoseBoxIsEmptyYet)
{
  std::vector<Box> boxes = random_boxes(20);
  BoxTree tree(boxes);
  for (LocalIndex i = 0; i < 40; ++i) tree.add({}, i);
  EXPECT_EQ(touching(tree, kAll).size(), 20U);
  boxes.resize(60, Box{{0.5, 0.5, 0.5}, {0.6, 0.6, 0.6}});
  for (LocalIndex i = 20; i < 60; ++i) tree.change(i, boxes[at(i)]);
  expect_finds_all(tree, boxes);
}

}  // namespace
}  // namespace tessera
