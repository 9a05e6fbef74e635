// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/search_tree.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

std::vector<Vec3> random_points(std::size_t num_points)
{
  std::mt19937 generator(7);
  const auto number = [&] { return static_cast<double>(generator() % 100) / 100.0; };
  std::vector<Vec3> points(num_points);
  for (Vec3& point : points) point = {number(), 3.0 * number(), number()};
  return points;
}

SearchTree tree_of(const std::vector<Vec3>& points)
{
  return SearchTree(
      static_cast<LocalIndex>(points.size()),
      [&](LocalIndex p) {
        return Box{points[at(p)], points[at(p)]};
      },
      [&](LocalIndex p, std::size_t axis) { return std::pair(points[at(p)][axis], p); });
}

double squared_distance(const Vec3& a, const Vec3& b) { return dot(a - b, a - b); }

TEST(SearchTree, HasEachItemInOneLeafOfABoxThatHoldsIt)
{
  const std::vector<Vec3> points = random_points(57);
  const SearchTree tree = tree_of(points);
  std::vector<int> num_leaves(points.size(), 0);
  for (const SearchTree::Node& node : tree.nodes()) {
    for (LocalIndex row = node.first; row < node.last; ++row) {
      const LocalIndex item = tree.order()[at(row)];
      EXPECT_TRUE(node.box.holds(points[at(item)]));
      if (node.is_leaf()) ++num_leaves[at(item)];
    }
  }
  EXPECT_EQ(num_leaves, std::vector<int>(points.size(), 1));
}

TEST(SearchTree, FindsTheLeastWithoutLookingAtAll)
{
  const std::vector<Vec3> points = random_points(400);
  const SearchTree tree = tree_of(points);
  const Vec3 wanted{0.4, 1.1, 0.6};
  double least = std::numeric_limits<double>::infinity();
  std::size_t num_looks = 0;
  tree.search([&](LocalIndex node) { return tree.nodes()[at(node)].box.squared_distance(wanted); },
              [&](double bound) { return bound < least; },
              [&](LocalIndex row) {
                ++num_looks;
                least =
                    std::min(least, squared_distance(points[at(tree.order()[at(row)])], wanted));
              });
  const auto distance = [&](const Vec3& point) { return squared_distance(point, wanted); };
  EXPECT_EQ(least, distance(std::ranges::min(points, {}, distance)));
  EXPECT_LT(num_looks, points.size() / 4);
}

TEST(SearchTree, ShowsEachNodeItsItems)
{
  const std::vector<Vec3> points = random_points(30);
  std::vector<std::size_t> sizes;
  const SearchTree tree(
      static_cast<LocalIndex>(points.size()), 8,
      [&](LocalIndex p) {
        return Box{points[at(p)], points[at(p)]};
      },
      [&](LocalIndex p, std::size_t axis) { return std::pair(points[at(p)][axis], p); },
      [&](std::span<const LocalIndex> items) { sizes.push_back(items.size()); });
  ASSERT_EQ(sizes.size(), tree.nodes().size());
  for (std::size_t n = 0; n < sizes.size(); ++n) {
    const SearchTree::Node& node = tree.nodes()[n];
    EXPECT_EQ(sizes[n], at(node.last - node.first));
    EXPECT_EQ(node.is_leaf(), sizes[n] <= 8);
  }
}

TEST(SearchTree, FindsNothingWithoutItems)
{
  const auto nothing = [](LocalIndex) { return 0.0; };
  SearchTree().search(
      nothing, [](double) { return true; }, [](LocalIndex) { ADD_FAILURE(); });
  SearchTree tree(
      0, [](LocalIndex) { return Box{}; }, [](LocalIndex item, std::size_t) { return item; });
  EXPECT_TRUE(tree.nodes().empty());
}

}  // namespace
}  // namespace tessera
