// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/edge_levels.hpp"

#include <array>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {
namespace {

const std::vector<LocalIndex> kEdges{0, 1, 0, 5, 1, 2, 1, 9, 4, 9};
const std::vector<std::int8_t> kLevels{2, 0, 1, 3, 2};

TEST(EdgeLevels, AreTheSameForAllEdgesUnlessTheyAreGiven)
{
  EXPECT_EQ(EdgeLevels(), EdgeLevels(0));
  const EdgeLevels levels = 3;
  EXPECT_TRUE(levels.is_uniform());
  EXPECT_EQ(levels.largest(), 3);
  EXPECT_EQ(levels.of(7, 2), 3);
  EXPECT_TRUE(levels.histogram().empty());
}

TEST(EdgeLevels, AreFoundByTheEdgesEnds)
{
  const EdgeLevels levels(kEdges, kLevels);
  EXPECT_FALSE(levels.is_uniform());
  EXPECT_EQ(levels.largest(), 3);
  for (std::size_t e = 0; e < kLevels.size(); ++e) {
    EXPECT_EQ(levels.of(kEdges[2 * e], kEdges[2 * e + 1]), kLevels[e]);
    EXPECT_EQ(levels.of(kEdges[2 * e + 1], kEdges[2 * e]), kLevels[e]);
  }
  EXPECT_EQ(levels.histogram(), (std::vector<GlobalIndex>{1, 1, 2, 1}));
}

TEST(EdgeLevels, AreFoundAmongMany)
{
  std::mt19937 random(3);
  for (int num_edges = 2; num_edges < 40; ++num_edges) {
    std::map<std::pair<LocalIndex, LocalIndex>, std::int8_t> level_of;
    while (static_cast<int>(level_of.size()) < num_edges) {
      const auto a = static_cast<LocalIndex>(random() % 20);
      const auto b = static_cast<LocalIndex>(random() % 20);
      if (a != b) level_of[std::minmax(a, b)] = static_cast<std::int8_t>(random() % 11);
    }
    level_of.begin()->second = 0;
    level_of.rbegin()->second = 10;
    std::vector<LocalIndex> edges;
    std::vector<std::int8_t> levels;
    for (const auto& [edge, level] : level_of) {
      edges.insert(edges.end(), {edge.first, edge.second});
      levels.push_back(level);
    }
    const EdgeLevels given(edges, levels);
    given.require_sound();
    for (const auto& [edge, level] : level_of) EXPECT_EQ(given.of(edge.second, edge.first), level);
  }
}

TEST(EdgeLevels, OfOneKindOnlyAreUniform)
{
  const EdgeLevels levels(kEdges, std::vector<std::int8_t>(5, 4));
  EXPECT_EQ(levels, EdgeLevels(4));
  EXPECT_EQ(EdgeLevels({}, {}), EdgeLevels(0));
  EXPECT_EQ(EdgeLevels({0, 1}, {2}), EdgeLevels(2));
  EXPECT_NE(EdgeLevels(kEdges, kLevels), EdgeLevels(3));
}

TEST(EdgeLevels, AreLimitedFromAboveAndBelow)
{
  const EdgeLevels levels(kEdges, kLevels);
  EXPECT_EQ(levels.limited(2), EdgeLevels(kEdges, {2, 0, 1, 2, 2}));
  EXPECT_EQ(levels.limited(3), levels);
  EXPECT_EQ(levels.limited(9), levels);
  EXPECT_EQ(levels.limited(0), EdgeLevels(0));
  EXPECT_EQ(levels.raised(1), EdgeLevels(kEdges, {2, 1, 1, 3, 2}));
  EXPECT_EQ(levels.raised(0), levels);
  EXPECT_EQ(levels.raised(3), EdgeLevels(3));
  EXPECT_EQ(levels.raised(5), EdgeLevels(5));
  EXPECT_EQ(EdgeLevels(3).limited(1), EdgeLevels(1));
  EXPECT_EQ(EdgeLevels(3).limited(4), EdgeLevels(3));
  EXPECT_EQ(EdgeLevels(3).raised(4), EdgeLevels(4));
  EXPECT_EQ(EdgeLevels(3).raised(2), EdgeLevels(3));
}

TEST(EdgeLevels, AreShiftedThereAndBack)
{
  const EdgeLevels levels(kEdges, kLevels);
  EXPECT_EQ(levels.shifted(2), EdgeLevels(kEdges, {4, 2, 3, 5, 4}));
  EXPECT_EQ(levels.shifted(2).largest(), 5);
  EXPECT_EQ(levels.shifted(2).shifted(-2), levels);
  EXPECT_EQ(levels.raised(2).shifted(-2), EdgeLevels(kEdges, {0, 0, 0, 1, 0}));
  EXPECT_EQ(EdgeLevels(3).shifted(-2), EdgeLevels(1));
}

TEST(EdgeLevels, AreReadAsTheyWereWritten)
{
  for (const EdgeLevels& levels :
       {EdgeLevels(), EdgeLevels(lattice::kMaxLevels), EdgeLevels(kEdges, kLevels)}) {
    EXPECT_EQ(from_bytes<EdgeLevels>(to_bytes(levels)), levels);
  }
}

// What a damaged record might hold.
struct RawLevels {
  std::int32_t largest = 0;
  std::vector<LocalIndex> first{};
  std::vector<LocalIndex> upper{};
  std::vector<std::int8_t> levels{};

  static auto fields(auto& self)
  {
    return std::tie(self.largest, self.first, self.upper, self.levels);
  }
};

const std::vector<LocalIndex> kFirst{0, 2, 4, 4, 4, 5};
const std::vector<LocalIndex> kUpper{1, 5, 2, 9, 9};

EdgeLevels read(const RawLevels& raw) { return from_bytes<EdgeLevels>(to_bytes(raw)); }

TEST(EdgeLevels, ThatCannotBeAreRefused)
{
  EXPECT_EQ(read({3, kFirst, kUpper, kLevels}), EdgeLevels(kEdges, kLevels));
  EXPECT_EQ(read({.largest = 2}), EdgeLevels(2));
  EXPECT_THROW(read({.largest = -1}), InputError);
  EXPECT_THROW(read({.largest = lattice::kMaxLevels + 1}), InputError);
  EXPECT_THROW(read({3, kFirst, kUpper, {2, 0, 1, 3}}), InputError);
  EXPECT_THROW(read({3, kFirst, kUpper, {2, 0, 1, 3, -1}}), InputError);
  EXPECT_THROW(read({11, kFirst, kUpper, {2, 0, 1, 11, 2}}), InputError);
  EXPECT_THROW(read({3, kFirst, {1, 5, 2, 9}, kLevels}), InputError);
}

TEST(EdgeLevels, WhoseListsAreNoneAreRefused)
{
  EXPECT_THROW(read({3, {}, kUpper, kLevels}), InputError);
  EXPECT_THROW(read({3, {0, 2, 4, 4, 4}, kUpper, kLevels}), InputError) << "another end";
  EXPECT_THROW(read({3, {1, 2, 4, 4, 4, 5}, kUpper, kLevels}), InputError) << "another begin";
  EXPECT_THROW(read({3, {0, 4, 2, 4, 4, 5}, kUpper, kLevels}), InputError);
  EXPECT_THROW(read({3, {0, -2, 4, 4, 4, 5}, kUpper, kLevels}), InputError);
}

TEST(EdgeLevels, WhoseEdgesDescendAreRefused)
{
  EXPECT_THROW(read({3, kFirst, {5, 1, 2, 9, 9}, kLevels}), InputError) << "rows descend";
  EXPECT_THROW(read({3, kFirst, {1, 1, 2, 9, 9}, kLevels}), InputError) << "a row twice";
  EXPECT_THROW(read({3, kFirst, {1, 5, 1, 9, 9}, kLevels}), InputError) << "from 1 to 1";
  EXPECT_THROW(read({3, kFirst, {-1, 5, 2, 9, 9}, kLevels}), InputError);
}

// histogram() and all loops over levels trust it.
TEST(EdgeLevels, WithAnotherLargestThanTheirsAreRefused)
{
  EXPECT_THROW(read({2, kFirst, kUpper, kLevels}), InputError);
  EXPECT_THROW(read({4, kFirst, kUpper, kLevels}), InputError);
  EXPECT_THROW(read({2, kFirst, kUpper, {2, 2, 2, 2, 2}}), InputError) << "these are uniform";
  EXPECT_THROW(read({2, kFirst, kUpper, {}}), InputError) << "these are uniform";
}

}  // namespace
}  // namespace tessera::mesh
